// SPDX-License-Identifier: BSD-3-Clause
// Takes hold of an object, pulls at it, and lets it fly.
#pragma once

#include <ode/ode.h>

#include <glm/glm.hpp>

namespace falling_objects {

class Hand {
 public:
  // The first mesh of a moving body that a ray from `eye` meets. Returns whether there is one.
  bool take(dSpaceID space, glm::vec3 eye, glm::vec3 direction);
  void release() { body_ = nullptr; }
  bool holds() const { return body_ != nullptr; }

  // To where the ray through the mouse is as far from the eye as the object was when taken.
  void move(glm::vec3 eye, glm::vec3 direction) { target_ = eye + distance_ * direction; }
  // Before every step: a spring that neither swings nor breaks.
  void pull() const;

 private:
  dBodyID body_ = nullptr;
  dVector3 place_{};  // where it is held, in the body's frame [m]
  glm::vec3 target_{0};
  float distance_ = 0;  // [m]
};

}  // namespace falling_objects
