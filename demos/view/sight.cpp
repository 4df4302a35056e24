// SPDX-License-Identifier: BSD-3-Clause
#include "view/sight.h"

#include <algorithm>
#include <glm/gtc/matrix_access.hpp>

namespace view {

Sight::Sight(const glm::mat4& clip_from_world, Size pixels) : depth_(glm::row(clip_from_world, 3)) {
  for (int i = 0; i < 6; ++i) {
    const glm::vec4 row = glm::row(clip_from_world, i / 2);
    const glm::vec4 plane = i % 2 == 0 ? depth_ + row : depth_ - row;
    const float length = glm::length(glm::vec3(plane));
    planes_[static_cast<std::size_t>(i)] = {glm::vec3(plane) / length, plane.w / length};
  }
  const auto across = [&](int axis, int count) {
    return 0.5F * static_cast<float>(count) *
           glm::length(glm::vec3(glm::row(clip_from_world, axis)));
  };
  per_depth_ = std::max(across(0, pixels.width), across(1, pixels.height));
}

bool Sight::sees(glm::vec3 center, float radius) const {
  return std::all_of(planes_.begin(), planes_.end(), [&](const Plane& plane) {
    return glm::dot(plane.normal, center) + plane.offset > -radius;
  });
}

float Sight::pixels_per_meter(glm::vec3 center, float radius) const {
  constexpr float kNearest = 1e-3F;
  const glm::vec3 ahead(depth_);
  const float depth = glm::dot(depth_, glm::vec4(center, 1)) - radius * glm::length(ahead);
  return per_depth_ / std::max(depth, kNearest);
}

}  // namespace view
