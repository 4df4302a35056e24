// SPDX-License-Identifier: BSD-3-Clause
// Meshlets, clusters of neighbouring triangles that a kernel tests sixteen at a time, and a tree
// over them. The term is of Kubisch, "Introduction to Turing Mesh Shaders", NVIDIA 2018.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/bvh.h"
#include "mesh/edges.h"
#include "mesh/meshlet_tree.h"

namespace ode_ext {

inline constexpr std::uint32_t kMeshletTriangles = 16;
inline constexpr std::uint32_t kMeshletVertices = 16;
inline constexpr std::uint32_t kMeshletEdges = 32;

// Triangles, the vertices at them, and those edges of which the first triangle is one of them: so
// an edge is in one meshlet, and its ends are among the vertices.
struct Meshlet {
  std::uint32_t triangle_first, triangle_count;  // in Meshlets::triangles
  std::uint32_t vertex_first, vertex_count;      // in Meshlets::vertices
  std::uint32_t edge_first, edge_count;          // in Meshlets::edges
};

struct Meshlets {
  std::vector<Meshlet> meshlets;
  std::vector<std::uint32_t> triangles, vertices, edges;  // indices into the mesh's
  std::vector<MeshletNode> tree;
};

// The largest subtrees of the BVH with at most so many triangles, vertices and edges.
Meshlets build_meshlets(const Bvh& bvh, const std::vector<Triangle>& triangles,
                        const std::vector<Edge>& edges);

// How much larger meshlets are than what is in them: the areas of their boxes, halves of each, over
// those of the triangles; 0 where these have none. Where triangles that lay side by side when the
// mesh was built are elsewhere now, as those of a sheet that was met rolled up, it grows.
double meshlet_spread(const Meshlets& meshlets, const std::vector<Vec3f>& vertices,
                      const std::vector<Triangle>& triangles);

}  // namespace ode_ext
