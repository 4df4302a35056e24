// SPDX-License-Identifier: BSD-3-Clause
#include "view/simplify.h"

#include <meshoptimizer.h>

namespace view {

std::vector<unsigned> simplify(std::span<const glm::vec3> positions,
                               std::span<const unsigned> triangles) {
  constexpr std::size_t kFewer = 6;
  constexpr float kError = 0.03F;  // of the mesh's size: a few pixels, where it is small
  const std::size_t target = triangles.size() / kFewer / 3 * 3;
  std::vector<unsigned> simple(triangles.size());
  if (triangles.empty()) return simple;
  simple.resize(meshopt_simplify(simple.data(), triangles.data(), triangles.size(),
                                 &positions.front().x, positions.size(), sizeof(glm::vec3), target,
                                 kError, 0, nullptr));
  return simple;
}

}  // namespace view
