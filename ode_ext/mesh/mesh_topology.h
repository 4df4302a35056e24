// SPDX-License-Identifier: BSD-3-Clause
// What of a mesh stays as it is while its vertices move: the triangles, and what is made of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/box.h"
#include "mesh/edges.h"
#include "mesh/meshlets.h"
#include "mesh/runs.h"
#include "mesh/source_triangles.h"
#include "mesh/triangle.h"
#include "mesh/vec.h"
#include "mesh/vertex_triangles.h"

namespace ode_ext {

// A run of at most kChunkVertices consecutive vertices, near one another in space.
struct VertexChunk {
  std::uint32_t first;
  std::uint32_t count;
  Box box;
  // Whether its edges alone, without vertices of other chunks, lead from each of them to each.
  bool joined = false;
};

inline constexpr std::uint32_t kChunkVertices = kRunLength;

// Vertices are welded by exact equality, in runs (runs.h), of deformable meshes in the order in
// which the program lists them. Boxes are those of the mesh as it was built.
struct MeshTopology {
  std::size_t vertex_count = 0;
  // Of deformable meshes: what it was made of.
  SourceTriangles source;
  // Oriented as `inverted` says; without collapsed triangles. By their vertices; of deformable
  // meshes in the program's order.
  std::vector<Triangle> triangles;
  // For each triangle its index in the program's mesh.
  std::vector<std::uint32_t> source_triangle;
  // Of deformable meshes: as in WeldedMesh.
  std::vector<std::uint32_t> corner_vertex;
  // For each triangle its facet, by the largest of its triangles (facets.h); empty for a deformable
  // mesh, whose triangles are facets each.
  std::vector<std::uint32_t> facets;
  // As in edges.h. Indices of edges count those between facets first, then those within one.
  std::vector<Edge> edges, flat_edges;
  const Edge& edge(std::uint32_t index) const {
    return index < edges.size() ? edges[index] : flat_edges[index - edges.size()];
  }
  std::vector<Sides> sides;  // of each triangle
  Meshlets meshlets;         // with these edges
  double spread = 0;         // of these, as the mesh was built (meshlet_spread)
  // A vertex of each part that these edges join, its lowest.
  std::vector<std::uint32_t> components;

  std::vector<VertexChunk> chunks;  // of the vertices

  bool closed = false;      // every edge is run as often one way as the other
  bool inverted = false;    // the winding was turned: the closed mesh had a negative volume
  bool reoriented = false;  // the winding was made consistent: each part now faces outward
  LazyVertexTriangles vertex_triangles;
};

}  // namespace ode_ext
