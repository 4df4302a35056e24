// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/grounds.h"

#include <algorithm>

namespace falling_objects {

bool reaches_under(const view::Box& box, const view::Box& moving) {
  const glm::vec3 middle = (moving.low + moving.high) / 2.0F;
  return box.low.x < moving.low.x && box.low.y < moving.low.y && box.high.x > moving.high.x &&
         box.high.y > moving.high.y && box.low.z < middle.z;
}

bool is_convex(const IndexedMesh& mesh) {
  const float tolerance = 1e-4F;
  // Each triangle against each vertex; of a fine mesh so many triangles that it takes a second at
  // most. What is not convex is so in many places.
  const std::size_t most = std::max<std::size_t>(1, 200'000'000 / mesh.positions.size());
  const std::size_t stride = 3 * (mesh.triangles.size() / 3 / most + 1);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += stride) {
    const glm::vec3 a = mesh.positions[mesh.triangles[i]];
    const glm::vec3 b = mesh.positions[mesh.triangles[i + 1]];
    const glm::vec3 c = mesh.positions[mesh.triangles[i + 2]];
    const glm::vec3 normal = glm::cross(b - a, c - a);
    const float allowed = tolerance * glm::length(normal);
    for (const glm::vec3& p : mesh.positions) {
      if (glm::dot(normal, p - a) > allowed) return false;
    }
  }
  return true;
}

void keep_top(IndexedMesh& mesh) {
  std::vector<unsigned> top;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
    const glm::vec3 a = mesh.positions[mesh.triangles[i]];
    const glm::vec3 b = mesh.positions[mesh.triangles[i + 1]];
    const glm::vec3 c = mesh.positions[mesh.triangles[i + 2]];
    const glm::vec3 normal = glm::cross(b - a, c - a);
    if (normal.z <= 0.02F * glm::length(normal)) continue;
    for (std::size_t k = 0; k < 3; ++k) top.push_back(mesh.triangles[i + k]);
  }
  mesh.triangles = top;
}

}  // namespace falling_objects
