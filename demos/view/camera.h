// SPDX-License-Identifier: BSD-3-Clause
// From where a world is looked at.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>

namespace view {

// Looks at a target from a distance: what a user turns, shifts and zooms.
struct Camera {
  glm::vec3 target{0};
  float distance = 10;     // [m]
  float azimuth = 0.9F;    // [rad] of the eye about z, from x
  float elevation = 0.6F;  // [rad] of the eye above the target

  glm::vec3 eye() const;
  // Field of view: 35 degrees across the shorter side.
  glm::mat4 clip_from_world(float aspect) const;
  // Unit, from the eye through a place of the picture: (-1, -1) bottom left to (1, 1) top right.
  glm::vec3 ray(glm::vec2 place, float aspect) const;
  // What fits across the shorter side at the distance of a place [m].
  float extent_at(glm::vec3 place) const;
  // Right and up as the picture has them, unit.
  glm::vec3 right() const;
  glm::vec3 up() const;

  void turn(float azimuth_by, float elevation_by);  // [rad]
  void shift(glm::vec2 by);                         // of the target, in heights of the picture
  void zoom(float factor);

  bool operator==(const Camera&) const = default;
};

// A camera that sees a whole ball.
Camera looking_at(glm::vec3 center, float radius);

// The camera, or one as far behind it as it takes to see all these places in a picture that is
// `aspect` times as wide as high.
Camera seeing(Camera camera, std::span<const glm::vec3> places, float aspect);

// `target` must be elsewhere than `eye`.
Camera camera_at(glm::vec3 eye, glm::vec3 target);

// Text of a command line: "x,y,z:tx,ty,tz", eye and target [m]; or "azimuth,elevation" [degrees]
// or "azimuth,elevation,distance" [m] about the target of `start`. Nothing where it is neither.
std::optional<Camera> parse_camera(const std::string& text, const Camera& start);

}  // namespace view
