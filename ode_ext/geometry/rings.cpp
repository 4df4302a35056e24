// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/rings.h"

#include <numeric>

namespace ode_ext {

Rings build_rings(std::size_t vertex_count, const std::vector<Edge>& edges) {
  Rings rings;
  rings.starts.resize(vertex_count + 1);
  for (const Edge& edge : edges)
    for (const std::uint32_t vertex : edge.vertices) ++rings.starts[vertex + 1];
  std::partial_sum(rings.starts.begin(), rings.starts.end(), rings.starts.begin());
  rings.neighbours.resize(2 * edges.size());
  std::vector<std::uint32_t> next(rings.starts.begin(), rings.starts.end() - 1);
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const auto& [p, q] = edges[i].vertices;
    rings.neighbours[next[p]++] = {q, i};
    rings.neighbours[next[q]++] = {p, i};
  }

  std::vector<bool> known(vertex_count);
  std::vector<std::uint32_t> stack;
  for (std::uint32_t first = 0; first < vertex_count; ++first) {
    if (known[first]) continue;
    rings.components.push_back(first);
    known[first] = true;
    stack.push_back(first);
    while (!stack.empty()) {
      const std::uint32_t v = stack.back();
      stack.pop_back();
      for (std::uint32_t k = rings.starts[v]; k < rings.starts[v + 1]; ++k) {
        const std::uint32_t w = rings.neighbours[k].vertex;
        if (known[w]) continue;
        known[w] = true;
        stack.push_back(w);
      }
    }
  }
  return rings;
}

}  // namespace ode_ext
