// SPDX-License-Identifier: BSD-3-Clause
#include "view/simplify.h"

#include <meshoptimizer.h>

namespace view {

std::vector<Level> levels_of(std::span<const glm::vec3> positions,
                             std::span<const unsigned> triangles) {
  constexpr std::size_t kFewer = 3, kFewest = 3 * 12;
  constexpr float kMostError = 0.1F;  // of the mesh's size
  std::vector<Level> levels{{{triangles.begin(), triangles.end()}, 0}};
  if (triangles.empty()) return levels;
  const float size =
      meshopt_simplifyScale(&positions.front().x, positions.size(), sizeof(glm::vec3));
  for (std::size_t count = triangles.size() / kFewer; count >= kFewest; count /= kFewer) {
    std::vector<unsigned> fewer(triangles.size());
    float error = 0;
    fewer.resize(meshopt_simplify(fewer.data(), triangles.data(), triangles.size(),
                                  &positions.front().x, positions.size(), sizeof(glm::vec3),
                                  count / 3 * 3, kMostError, 0, &error));
    if (fewer.size() > levels.back().triangles.size() * 2 / 3) break;
    levels.push_back({std::move(fewer), error * size});
  }
  return levels;
}

}  // namespace view
