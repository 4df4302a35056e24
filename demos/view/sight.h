// SPDX-License-Identifier: BSD-3-Clause
// What a projection sees of a ball, and how large: the camera's, and the sun's that casts shadows.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "view/image.h"

namespace view {

class Sight {
 public:
  Sight(const glm::mat4& clip_from_world, Size pixels);

  bool sees(glm::vec3 center, float radius) const;
  // [pixels] that a meter is long at most where the ball is nearest.
  float pixels_per_meter(glm::vec3 center, float radius) const;
  float pixel_at_depth_one() const { return 1 / per_depth_; }  // how wide it is [m]

 private:
  struct Plane {
    glm::vec3 normal;  // inward, unit
    float offset;
  };
  std::array<Plane, 6> planes_;
  glm::vec4 depth_;  // of a place, in clip coordinates: 1 everywhere for a parallel projection
  float per_depth_;  // [pixels] that a meter is long at depth 1
};

}  // namespace view
