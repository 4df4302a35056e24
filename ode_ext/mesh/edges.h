// SPDX-License-Identifier: BSD-3-Clause
// The edges of a mesh that are worth casting: those between facets, where its surface bends, and as
// many within facets as join the vertices of each. What is at the sides of its triangles, and how
// many parts it has.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"
#include "mesh/vec.h"

namespace ode_ext {

struct Edge {
  // By their places, however they are numbered: an inverted mesh has the edges of the upright one.
  // Of a deformable mesh by their numbers.
  std::array<std::uint32_t, 2> vertices;
  // The first runs the edge from the first vertex on. The second is kNone where there is none.
  std::array<std::uint32_t, 2> triangles;
};

// What is at each side of a triangle, from corner k to corner (k + 1) % 3: an edge between facets;
// or within a facet kWithinFacet with the triangle across, a neighbour as in neighbours.h; kNone
// where triangles of one facet meet that are no neighbours.
using Sides = std::array<std::uint32_t, 3>;
inline constexpr std::uint32_t kWithinFacet = 1u << 31;

struct Edges {
  // Both by their vertices, the lower and then the higher: of rigid meshes these lie in runs
  // (runs.h), and so do the edges.
  std::vector<Edge> apart;  // between facets
  // Within a facet: none of which the ends are joined by the others of the facet and its rim. So
  // each two vertices that any edges of the mesh join, these join too, and the rim of a hole with
  // that about it: where one is inside another mesh, by what edge it comes out is told.
  std::vector<Edge> flat;
  std::vector<Sides> sides;               // of each triangle
  std::vector<std::uint32_t> components;  // a vertex of each part that edges join, its lowest
};

// `facets` as facets.h gives them. Where these are empty, every edge is between facets. Where more
// than two triangles meet, they are taken two by two: each of them is at one of the edges.
Edges find_edges(const std::vector<Vec3f>& vertices, const std::vector<HalfEdge>& half_edges,
                 const std::vector<std::uint32_t>& facets);

}  // namespace ode_ext
