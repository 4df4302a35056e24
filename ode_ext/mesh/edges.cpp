// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/edges.h"

#include <array>
#include <tuple>
#include <utility>

#include "mesh/edge_pairs.h"
#include "mesh/joined.h"

namespace ode_ext {
namespace {

bool comes_before(const Vec3f& a, const Vec3f& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// The place of an end of a half-edge among the corners of all triangles.
std::uint32_t corner_of(const HalfEdge& half_edge, bool low) {
  const std::uint32_t first = half_edge.side;
  return low == half_edge.upward ? first : first / 3 * 3 + (first + 1) % 3;
}

// Of the flat edges those that join what of their facet's rim and vertices nothing else of the
// facet joins. `flat`: a half-edge of each, with that across beside it.
void keep_joining(const std::vector<std::array<HalfEdge, 2>>& flat, Edges* edges) {
  Joined corners(3 * edges->sides.size());
  for (const auto& [one, other] : flat)
    for (const bool low : {true, false}) corners.join(corner_of(one, low), corner_of(other, low));
  for (std::uint32_t t = 0; t < edges->sides.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k)
      if ((edges->sides[t][k] & kWithinFacet) == 0) corners.join(3 * t + k, 3 * t + (k + 1) % 3);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < flat.size(); ++i)
    if (corners.join(corner_of(flat[i][0], true), corner_of(flat[i][0], false)))
      edges->flat[kept++] = edges->flat[i];
  edges->flat.resize(kept);
}

}  // namespace

Edges find_edges(const std::vector<Vec3f>& vertices, const std::vector<HalfEdge>& half_edges,
                 const std::vector<std::uint32_t>& facets) {
  Edges edges;
  edges.sides.assign(half_edges.size() / 3, {kNone, kNone, kNone});
  const auto side_of = [&](std::uint32_t side) -> std::uint32_t& {
    return edges.sides[side / 3][side % 3];
  };
  std::vector<std::array<HalfEdge, 2>> flat;
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
      flat.push_back({a, b});
      if (!neighbours) continue;
      side_of(a.side) = b.side / 3 | kWithinFacet;
      side_of(b.side) = a.side / 3 | kWithinFacet;
      continue;
    }
    for (const std::uint32_t side : {a.side, b.side})
      side_of(side) = static_cast<std::uint32_t>(edges.apart.size());
    edges.apart.push_back(edge);
  }
  if (!flat.empty()) keep_joining(flat, &edges);
  Joined joined(vertices.size());
  for (const std::vector<Edge>* of : {&edges.apart, &edges.flat})
    for (const Edge& edge : *of) joined.join(edge.vertices[0], edge.vertices[1]);
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    if (joined.lowest(v) == v) edges.components.push_back(v);
  return edges;
}

}  // namespace ode_ext
