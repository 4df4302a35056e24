// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/directed_edges.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace ode_ext {

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

}  // namespace ode_ext
