// SPDX-License-Identifier: BSD-3-Clause
// A collision mesh: what is computed once per mesh and never depends on a pose.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/box.h"
#include "geometry/bvh.h"
#include "geometry/clearance_grid.h"
#include "geometry/occupancy_grid.h"
#include "geometry/vec.h"

namespace ode_ext {

// Corners of the triangles as the program holds them: 3 per triangle, local frame [m].
using TriangleSoup = std::vector<Vec3f>;

// A run of at most kChunkVertices consecutive vertices, near one another in space.
struct VertexChunk {
  std::uint32_t first;
  std::uint32_t count;
  Box box;
};

inline constexpr std::uint32_t kChunkVertices = 16;

struct Mesh {
  // Vertices welded by exact equality, sorted along a space-filling curve [m], local frame.
  std::vector<Vec3f> vertices;
  // Unit, outward, angle-weighted; rays are cast along their negatives.
  std::vector<Vec3f> normals;
  // Where a ray from the vertex along -normal leaves this mesh [m]; infinity if it never does.
  std::vector<float> exits;

  // Corner indices into `vertices`, oriented as `inverted` says; without collapsed triangles.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // For each triangle its index in the program's mesh.
  std::vector<std::uint32_t> source_triangle;
  // Unit normal of each triangle; zero where its area is zero.
  std::vector<Vec3f> face_normals;

  Bvh bvh;                          // over `triangles`
  OccupancyGrid grid;               // of closed meshes, if asked for: the cells not outside
  ClearanceGrid clearance;          // of `grid`
  std::vector<VertexChunk> chunks;  // of `vertices`

  Box box{};
  float radius = 0;         // largest distance of a vertex from centre(box), rounded up [m]
  float mean_edge = 0;      // [m]
  bool closed = false;      // every edge has exactly two triangles, of opposite direction
  bool inverted = false;    // the winding was turned: the closed mesh had a negative volume
  bool reoriented = false;  // the winding was made consistent: each part now faces outward
  bool finite = true;       // false: a coordinate is NaN or infinite, everything above is empty
  std::uint64_t content_hash = 0;  // of the soup: equal soups have equal hashes
};

struct MeshOptions {
  float open_thickness = 0;    // [m] bounds the exits of an open mesh; 0: its mean edge
  bool occupancy_grid = true;  // worth building for a mesh that lives for more than a step or two
};

// Builds everything above. Throws std::bad_alloc only.
Mesh build_mesh(const TriangleSoup& soup, const MeshOptions& options = {});

// The hash that build_mesh stores, alone: cheap enough for every pass.
std::uint64_t hash_soup(const Vec3f* corners, std::size_t corner_count);

}  // namespace ode_ext
