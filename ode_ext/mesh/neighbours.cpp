// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/neighbours.h"

#include "mesh/edge_pairs.h"

namespace ode_ext {

std::vector<Neighbours> neighbours(std::size_t triangle_count,
                                   const std::vector<HalfEdge>& half_edges) {
  std::vector<Neighbours> result(triangle_count, Neighbours{kNone, kNone, kNone});
  for (std::size_t begin = 0, end = 0; begin < half_edges.size(); begin = end) {
    end = end_of_edge(half_edges, begin);
    if (!are_pairs(half_edges, begin, end)) continue;
    for (std::size_t i = begin; i < end; i += 2) {
      const HalfEdge &a = half_edges[i], &b = half_edges[i + 1];
      result[a.side / 3][a.side % 3] = b.side / 3;
      result[b.side / 3][b.side % 3] = a.side / 3;
    }
  }
  return result;
}

}  // namespace ode_ext
