// SPDX-License-Identifier: BSD-3-Clause
// A collision mesh: what is computed once per mesh and never depends on a pose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mesh/box.h"
#include "mesh/mesh_topology.h"
#include "mesh/source_triangles.h"
#include "mesh/vec.h"

namespace ode_ext {

// A topology and where its vertices are: a mesh as it was built, or a shape it has taken since.
struct Mesh {
  std::shared_ptr<const MeshTopology> topology = std::make_shared<const MeshTopology>();
  SourceTriangles source;  // what it was made of
  // Where the frame of all that follows begins in that of the source, whose axes it has [m]:
  // origin.h; 0 for a deformable mesh, or its past would decide how its shapes are rounded.
  Vec3f origin;
  std::vector<Vec3f> vertices;  // [m], exact; as MeshTopology numbers them
  // Unit, outward, angle-weighted; rays are cast along their negatives. These and the exits are
  // empty for a deformable mesh: the device makes them.
  std::vector<Vec3f> normals;
  // Where a ray from the vertex along -normal leaves this mesh [m]; infinity if it never does.
  std::vector<float> exits;

  Box box{};
  // Largest distance of a vertex, or for a deformable mesh of its box, from centre(box), rounded up
  // [m].
  float radius = 0;
  float mean_edge = 0;       // [m]
  bool finite = true;        // false: a coordinate is NaN or infinite, all but the source is empty
  bool deformable = false;   // its vertices are expected to move
  float open_thickness = 0;  // of deformable meshes: as in MeshOptions
  std::uint64_t content_hash = 0;  // hash_soup(source)
  // Of the welded vertices, so that it is the same however the triangles are ordered or wound; of
  // deformable meshes that of the source, whose vertices keep the order they were built in.
  std::uint64_t shape_hash = 0;

  bool closed() const { return topology->closed; }
};

// Unit, of a rigid mesh as floats, which the device has; zero where the area is zero.
Vec3d face_normal(const Mesh& mesh, std::uint32_t triangle);

// The box in the frame of the source, exact.
Box box_as_given(const Mesh& mesh);

struct MeshOptions {
  float open_thickness = 0;  // [m] bounds the exits of an open mesh; 0: its mean edge
  bool deformable = false;
};

// Builds everything above. Throws std::bad_alloc only.
Mesh build_mesh(SourceTriangles source, const MeshOptions& options = {});

}  // namespace ode_ext
