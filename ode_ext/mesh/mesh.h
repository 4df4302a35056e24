// SPDX-License-Identifier: BSD-3-Clause
// A collision mesh: what is computed once per mesh and never depends on a pose.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/box.h"
#include "mesh/bvh.h"
#include "mesh/edges.h"
#include "mesh/meshlets.h"
#include "mesh/neighbours.h"
#include "mesh/rings.h"
#include "mesh/runs.h"
#include "mesh/vec.h"

namespace ode_ext {

// Corners of the triangles as the program holds them: 3 per triangle, local frame [m].
using TriangleSoup = std::vector<Vec3f>;

// A run of at most kChunkVertices consecutive vertices, near one another in space.
struct VertexChunk {
  std::uint32_t first;
  std::uint32_t count;
  Box box;
};

inline constexpr std::uint32_t kChunkVertices = kRunLength;

// A mesh as it was built, or a shape of a deformable one: then `base` is the mesh as it was built,
// and only the vertices, what is measured of them and the flags are the shape's own.
struct Mesh {
  // What it was made of, bit for bit: by this it is known to be unchanged, or the same as another.
  // 36 bytes a triangle, about a tenth of the rest.
  TriangleSoup soup;
  // Vertices welded by exact equality, in runs (runs.h), of deformable meshes in the order in which
  // the program lists them [m], local frame. Those of a shape are in the order of its base.
  std::vector<Vec3f> vertices;
  // Unit, outward, angle-weighted; rays are cast along their negatives. These, the exits and the
  // normals of the faces are empty for a deformable mesh: the device makes them.
  std::vector<Vec3f> normals;
  // Where a ray from the vertex along -normal leaves this mesh [m]; infinity if it never does.
  std::vector<float> exits;

  // Corner indices into `vertices`, oriented as `inverted` says; without collapsed triangles. By
  // their vertices; of deformable meshes in the program's order.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  // For each triangle its index in the program's mesh.
  std::vector<std::uint32_t> source_triangle;
  // Of deformable meshes: as in WeldedMesh.
  std::vector<std::uint32_t> corner_vertex;
  // Unit normal of each triangle; zero where its area is zero.
  std::vector<Vec3f> face_normals;
  // The triangles across each triangle's edges.
  std::vector<Neighbours> neighbours;
  // For each triangle the number of its facet (facets.h); empty for a deformable mesh, whose
  // triangles are facets each.
  std::vector<std::uint32_t> facets;
  // As in edges.h. Indices of edges count those between facets first, then those within one.
  std::vector<Edge> edges, flat_edges;
  Meshlets meshlets;  // of `bvh`, with these edges
  Rings rings;        // of these edges

  Bvh bvh;                          // over `triangles`
  std::vector<VertexChunk> chunks;  // of `vertices`

  Box box{};
  // Largest distance of a vertex, or for a deformable mesh of its box, from centre(box), rounded up
  // [m].
  float radius = 0;
  float mean_edge = 0;       // [m]
  bool closed = false;       // every edge has exactly two triangles, of opposite direction
  bool inverted = false;     // the winding was turned: the closed mesh had a negative volume
  bool reoriented = false;   // the winding was made consistent: each part now faces outward
  bool finite = true;        // false: a coordinate is NaN or infinite, all but the soup is empty
  bool deformable = false;   // its vertices are expected to move
  float open_thickness = 0;  // of deformable meshes: as in MeshOptions
  std::uint64_t content_hash = 0;  // of the soup: equal soups have equal hashes
  // Of the welded vertices, so that it is the same however the triangles are ordered or wound; of
  // deformable meshes that of the soup, whose vertices keep the order they were built in.
  std::uint64_t shape_hash = 0;
  std::shared_ptr<const Mesh> base;
};

// The mesh that holds triangles, BVH and chunks.
inline const Mesh& topology(const Mesh& mesh) { return mesh.base ? *mesh.base : mesh; }

// Unit; zero where the area is zero. `triangle` is an index into topology(mesh).triangles.
Vec3d face_normal(const Mesh& mesh, std::uint32_t triangle);

struct MeshOptions {
  float open_thickness = 0;  // [m] bounds the exits of an open mesh; 0: its mean edge
  bool deformable = false;
};

// Builds everything above. Throws std::bad_alloc only.
Mesh build_mesh(const TriangleSoup& soup, const MeshOptions& options = {});

// The hash that build_mesh stores, alone. What has one hash need not be one soup (soup_hash.cpp).
std::uint64_t hash_soup(const Vec3f* corners, std::size_t corner_count);

// A total order of soups by their bits: 0 for the same, and a NaN is the same as itself.
int compare_soups(const TriangleSoup& a, const TriangleSoup& b);

}  // namespace ode_ext
