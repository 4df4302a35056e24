// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/edges.h"

#include <tuple>
#include <utility>

#include "mesh/joined.h"
#include "mesh/runs.h"

namespace ode_ext {
namespace {

bool comes_before(const Vec3f& a, const Vec3f& b) {
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

}  // namespace

Edges find_edges(const std::vector<Vec3f>& vertices, const std::vector<HalfEdge>& half_edges,
                 const std::vector<std::uint32_t>& facets) {
  Edges edges;
  std::vector<Edge> found;
  std::vector<Vec3f> middles;
  for (std::size_t i = 0; i < half_edges.size();) {
    const HalfEdge& a = half_edges[i];
    const bool paired = i + 1 < half_edges.size() && same_edge(a, half_edges[i + 1]);
    Edge edge{{a.low, a.high}, {a.side / 3, paired ? half_edges[i + 1].side / 3 : kNone}};
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
      continue;
    }
    found.push_back(edge);
    middles.push_back(0.5f * vertices[edge.vertices[0]] + 0.5f * vertices[edge.vertices[1]]);
  }
  Joined joined(vertices.size());
  const auto join = [&](const Edge& edge) {
    return joined.join(edge.vertices[0], edge.vertices[1]);
  };
  for (const Edge& edge : found) join(edge);
  std::erase_if(edges.flat, [&](const Edge& edge) { return !join(edge); });
  if (facets.empty()) {
    edges.apart = std::move(found);
    return edges;
  }
  edges.apart.reserve(found.size());
  for (const std::uint32_t i : order_into_runs(middles)) edges.apart.push_back(found[i]);
  return edges;
}

}  // namespace ode_ext
