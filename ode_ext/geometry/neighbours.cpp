// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/neighbours.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include "geometry/ray_cast.h"

namespace ode_ext {
namespace {

struct DirectedEdge {
  std::uint32_t low, high;  // corners
  std::uint32_t side;       // 3 * triangle + first corner
  bool upward;              // runs from `low` to `high`
};

bool same_edge(const DirectedEdge& a, const DirectedEdge& b) {
  return a.low == b.low && a.high == b.high;
}

// The sides of an edge follow one another.
std::vector<DirectedEdge> sorted_edges(const std::vector<Triangle>& triangles) {
  std::vector<DirectedEdge> edges;
  edges.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangle[k], to = triangle[(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to),
                       static_cast<std::uint32_t>(edges.size()), from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const DirectedEdge& a, const DirectedEdge& b) {
    return std::tie(a.low, a.high, a.side) < std::tie(b.low, b.high, b.side);
  });
  return edges;
}

}  // namespace

std::vector<Neighbours> neighbours(const std::vector<Triangle>& triangles) {
  std::vector<Neighbours> result(triangles.size(), Neighbours{kNone, kNone, kNone});
  const std::vector<DirectedEdge> edges = sorted_edges(triangles);
  for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
    while (next < edges.size() && same_edge(edges[i], edges[next])) ++next;
    if (next - i != 2) continue;
    const DirectedEdge &a = edges[i], &b = edges[i + 1];
    if (a.upward == b.upward) continue;
    result[a.side / 3][a.side % 3] = b.side / 3;
    result[b.side / 3][b.side % 3] = a.side / 3;
  }
  return result;
}

}  // namespace ode_ext
