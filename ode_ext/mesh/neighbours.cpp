// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/neighbours.h"

namespace ode_ext {

std::vector<Neighbours> neighbours(std::size_t triangle_count,
                                   const std::vector<HalfEdge>& half_edges) {
  std::vector<Neighbours> result(triangle_count, Neighbours{kNone, kNone, kNone});
  for (std::size_t i = 0, next = 0; i < half_edges.size(); i = next) {
    while (next < half_edges.size() && same_edge(half_edges[i], half_edges[next])) ++next;
    if (next - i != 2) continue;
    const HalfEdge &a = half_edges[i], &b = half_edges[i + 1];
    if (a.upward == b.upward) continue;
    result[a.side / 3][a.side % 3] = b.side / 3;
    result[b.side / 3][b.side % 3] = a.side / 3;
  }
  return result;
}

}  // namespace ode_ext
