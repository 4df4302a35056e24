// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/neighbours.h"

#include <cstddef>

#include "mesh/directed_edges.h"
#include "mesh/ray_cast.h"

namespace ode_ext {

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
