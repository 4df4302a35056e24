// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/edges.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/directed_edges.h"
#include "geometry/ray_cast.h"
#include "geometry/runs.h"

namespace ode_ext {
namespace {

// Which vertices are joined (union-find, with path halving).
class Joined {
 public:
  explicit Joined(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  // False: they were joined before.
  bool join(const std::array<std::uint32_t, 2>& ends) {
    const std::uint32_t a = root(ends[0]), b = root(ends[1]);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::uint32_t root(std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  std::vector<std::uint32_t> parent_;
};

}  // namespace

Edges find_edges(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
                 const std::vector<std::uint32_t>& facets) {
  Edges edges;
  std::vector<Edge> found;
  std::vector<Vec3f> middles;
  const std::vector<DirectedEdge> sides = sorted_edges(triangles);
  for (std::size_t i = 0; i < sides.size();) {
    const DirectedEdge& a = sides[i];
    const bool paired = i + 1 < sides.size() && same_edge(a, sides[i + 1]);
    Edge edge{{a.low, a.high}, {a.side / 3, paired ? sides[i + 1].side / 3 : kNone}};
    // By the direction in which they run the edge, not by their numbers.
    if (paired && !a.upward) std::swap(edge.triangles[0], edge.triangles[1]);
    i += paired ? 2 : 1;
    if (paired && !facets.empty() && facets[edge.triangles[0]] == facets[edge.triangles[1]]) {
      edges.flat.push_back(edge);
      continue;
    }
    found.push_back(edge);
    middles.push_back(0.5f * vertices[edge.vertices[0]] + 0.5f * vertices[edge.vertices[1]]);
  }
  Joined joined(vertices.size());
  for (const Edge& edge : found) joined.join(edge.vertices);
  std::erase_if(edges.flat, [&](const Edge& edge) { return !joined.join(edge.vertices); });
  if (facets.empty()) {
    edges.apart = std::move(found);
    return edges;
  }
  edges.apart.reserve(found.size());
  for (const std::uint32_t i : order_into_runs(middles)) edges.apart.push_back(found[i]);
  return edges;
}

}  // namespace ode_ext
