// SPDX-License-Identifier: BSD-3-Clause
#include "support/surface_graph.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace ode_ext::test {

SurfaceGraph::SurfaceGraph(const TestMesh& mesh) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.vertex_count()); ++i) {
    vertices_.push_back(mesh.vertex(i));
  }
  std::map<std::pair<unsigned, unsigned>, unsigned> numbers;
  std::vector<int> triangles_at;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    corners_.push_back({mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]});
    auto& sides = sides_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [from, to] = std::minmax(corners_.back()[k], corners_.back()[(k + 1) % 3]);
      const auto [at, is_new] =
          numbers.try_emplace({from, to}, static_cast<unsigned>(edges_.size()));
      if (is_new) {
        edges_.push_back({from, to});
        triangles_at.push_back(0);
      }
      sides[k] = at->second;
      ++triangles_at[at->second];
    }
  }
  closed_ = std::all_of(triangles_at.begin(), triangles_at.end(), [](int n) { return n == 2; });

  first_at_.assign(vertices_.size() + 1, 0);
  for (const Edge& e : edges_) ++first_at_[e.from + 1], ++first_at_[e.to + 1];
  std::partial_sum(first_at_.begin(), first_at_.end(), first_at_.begin());
  at_vertex_.resize(2 * edges_.size());
  std::vector<unsigned> next(first_at_.begin(), first_at_.end() - 1);
  for (unsigned i = 0; i < edges_.size(); ++i) {
    at_vertex_[next[edges_[i].from]++] = i;
    at_vertex_[next[edges_[i].to]++] = i;
  }
}

}  // namespace ode_ext::test
