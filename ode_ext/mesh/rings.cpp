// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/rings.h"

#include <numeric>

namespace ode_ext {

Rings build_rings(std::size_t vertex_count, const std::vector<Edge>& edges,
                  const std::vector<Edge>& flat_edges) {
  Rings rings;
  rings.starts.resize(vertex_count + 1);
  for (const auto* some : {&edges, &flat_edges})
    for (const Edge& edge : *some)
      for (const std::uint32_t vertex : edge.vertices) ++rings.starts[vertex + 1];
  std::partial_sum(rings.starts.begin(), rings.starts.end(), rings.starts.begin());
  rings.neighbours.resize(rings.starts.back());
  std::vector<std::uint32_t> next(rings.starts.begin(), rings.starts.end() - 1);
  std::uint32_t i = 0;
  for (const auto* some : {&edges, &flat_edges})
    for (const Edge& edge : *some) {
      const auto& [p, q] = edge.vertices;
      rings.neighbours[next[p]++] = {q, i};
      rings.neighbours[next[q]++] = {p, i};
      ++i;
    }
  return rings;
}

}  // namespace ode_ext
