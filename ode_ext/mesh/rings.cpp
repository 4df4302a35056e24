// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/rings.h"

#include <numeric>

#include "mesh/joined.h"

namespace ode_ext {

Rings build_rings(std::size_t vertex_count, const std::vector<Edge>& edges) {
  Rings rings;
  rings.starts.resize(vertex_count + 1);
  for (const Edge& edge : edges)
    for (const std::uint32_t vertex : edge.vertices) ++rings.starts[vertex + 1];
  std::partial_sum(rings.starts.begin(), rings.starts.end(), rings.starts.begin());
  rings.neighbours.resize(2 * edges.size());
  std::vector<std::uint32_t> next(rings.starts.begin(), rings.starts.end() - 1);
  Joined joined(vertex_count);
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const auto& [p, q] = edges[i].vertices;
    rings.neighbours[next[p]++] = {q, i};
    rings.neighbours[next[q]++] = {p, i};
    joined.join(p, q);
  }
  for (std::uint32_t v = 0; v < vertex_count; ++v)
    if (joined.lowest(v) == v) rings.components.push_back(v);
  return rings;
}

}  // namespace ode_ext
