// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/edges.h"

#include <tuple>
#include <utility>

#include "mesh/edge_pairs.h"
#include "mesh/joined.h"

namespace ode_ext {
namespace {

bool comes_before(const Vec3f& a, const Vec3f& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

}  // namespace

Edges find_edges(const std::vector<Vec3f>& vertices, const std::vector<HalfEdge>& half_edges,
                 const std::vector<std::uint32_t>& facets) {
  Edges edges;
  edges.sides.assign(half_edges.size() / 3, {kNone, kNone, kNone});
  const auto side_of = [&](std::uint32_t side) -> std::uint32_t& {
    return edges.sides[side / 3][side % 3];
  };
  bool neighbours = false;  // those at the edge are, two by two
  for (std::size_t i = 0, end = 0; i < half_edges.size();) {
    if (i == end) {
      end = end_of_edge(half_edges, i);
      neighbours = are_pairs(half_edges, i, end);
    }
    const HalfEdge& a = half_edges[i];
    const bool paired = i + 1 < end;
    const HalfEdge& b = half_edges[paired ? i + 1 : i];
    Edge edge{{a.low, a.high}, {a.side / 3, paired ? b.side / 3 : kNone}};
    // By the direction in which they run the edge, not by their numbers.
    if (paired && !a.upward) std::swap(edge.triangles[0], edge.triangles[1]);
    // Where a deformable mesh's vertices are changes.
    if (!facets.empty() && comes_before(vertices[a.high], vertices[a.low])) {
      std::swap(edge.vertices[0], edge.vertices[1]);
      if (paired) std::swap(edge.triangles[0], edge.triangles[1]);
    }
    i += paired ? 2 : 1;
    if (paired && !facets.empty() && facets[edge.triangles[0]] == facets[edge.triangles[1]]) {
      edges.flat.push_back(edge);
      if (!neighbours) continue;
      side_of(a.side) = b.side / 3 | kWithinFacet;
      side_of(b.side) = a.side / 3 | kWithinFacet;
      continue;
    }
    for (const std::uint32_t side : {a.side, b.side})
      side_of(side) = static_cast<std::uint32_t>(edges.apart.size());
    edges.apart.push_back(edge);
  }
  Joined joined(vertices.size());
  const auto join = [&](const Edge& edge) {
    return joined.join(edge.vertices[0], edge.vertices[1]);
  };
  for (const Edge& edge : edges.apart) join(edge);
  std::erase_if(edges.flat, [&](const Edge& edge) { return !join(edge); });
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    if (joined.lowest(v) == v) edges.components.push_back(v);
  return edges;
}

}  // namespace ode_ext
