// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/half_edges.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace ode_ext {

// By the lower corner they are counted into place, a few to each; only those few are compared.
std::vector<HalfEdge> half_edges_of(const std::vector<Triangle>& triangles) {
  std::uint32_t corners = 0;
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t corner : triangle) corners = std::max(corners, corner + 1);
  std::vector<std::uint32_t> next(corners + 1);
  for (const Triangle& triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k) ++next[std::min(triangle[k], triangle[(k + 1) % 3]) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());

  std::vector<HalfEdge> edges(3 * triangles.size());
  std::uint32_t side = 0;
  for (const Triangle& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k, ++side) {
      const std::uint32_t from = triangle[k], to = triangle[(k + 1) % 3];
      const std::uint32_t low = std::min(from, to);
      edges[next[low]++] = {low, std::max(from, to), side, from < to};
    }
  }
  for (std::uint32_t corner = 0, first = 0; corner < corners; first = next[corner++])
    std::sort(edges.begin() + first, edges.begin() + next[corner],
              [](const HalfEdge& a, const HalfEdge& b) {
                return a.high != b.high ? a.high < b.high : a.side < b.side;
              });
  return edges;
}

}  // namespace ode_ext
