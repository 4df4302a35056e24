// SPDX-License-Identifier: BSD-3-Clause
#include "view/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <sstream>
#include <vector>

namespace view {
namespace {

constexpr float kFieldOfView = glm::radians(35.0F);  // across the shorter side
constexpr float kSteepest = glm::radians(89.0F);     // straight down no side would be up

// Tangent of half the field of view from bottom to top.
float half_height(float aspect) { return std::tan(kFieldOfView / 2) / std::min(aspect, 1.0F); }

// "1,2,3" as numbers; empty where it is anything else.
std::vector<float> numbers_of(const std::string& text) {
  std::vector<float> numbers;
  std::istringstream in(text);
  float number = 0;
  while (in >> number) {
    if (!std::isfinite(number)) return {};
    numbers.push_back(number);
    char comma = 0;
    if (!(in >> comma)) return numbers;
    if (comma != ',') return {};
  }
  return {};
}

}  // namespace

glm::vec3 Camera::eye() const {
  const float level = std::cos(elevation);
  return target + distance * glm::vec3(level * std::cos(azimuth), level * std::sin(azimuth),
                                       std::sin(elevation));
}

glm::mat4 Camera::clip_from_world(float aspect) const {
  return glm::perspective(2 * std::atan(half_height(aspect)), aspect, distance / 50,
                          distance * 20) *
         glm::lookAt(eye(), target, glm::vec3(0, 0, 1));
}

glm::vec3 Camera::ray(glm::vec2 place, float aspect) const {
  const float half = half_height(aspect);
  const glm::vec3 ahead = glm::normalize(target - eye());
  return glm::normalize(ahead + right() * (place.x * half * aspect) + up() * (place.y * half));
}

float Camera::extent_at(glm::vec3 place) const {
  return 2 * glm::length(place - eye()) * std::tan(kFieldOfView / 2);
}

Camera seeing(Camera camera, std::span<const glm::vec3> places, float aspect) {
  constexpr int kMostSteps = 60;  // ten times as far
  constexpr float kStep = 1.04F, kRim = 0.97F;
  const auto sees = [&](const glm::mat4& clip_from_world) {
    return std::all_of(places.begin(), places.end(), [&](const glm::vec3& place) {
      const glm::vec4 clip = clip_from_world * glm::vec4(place, 1);
      return std::max(std::abs(clip.x), std::abs(clip.y)) <= kRim * clip.w;
    });
  };
  for (int i = 0; i < kMostSteps && !sees(camera.clip_from_world(aspect)); ++i) camera.zoom(kStep);
  return camera;
}

glm::vec3 Camera::right() const { return {-std::sin(azimuth), std::cos(azimuth), 0}; }

glm::vec3 Camera::up() const {
  return glm::normalize(glm::cross(right(), glm::normalize(target - eye())));
}

void Camera::turn(float azimuth_by, float elevation_by) {
  azimuth += azimuth_by;
  elevation = std::clamp(elevation + elevation_by, -kSteepest, kSteepest);
}

void Camera::shift(glm::vec2 by) {
  const float height = 2 * distance * std::tan(kFieldOfView / 2);
  target += height * (by.x * right() + by.y * up());
}

void Camera::zoom(float factor) { distance = std::clamp(distance * factor, 0.05F, 10000.0F); }

Camera looking_at(glm::vec3 center, float radius) {
  Camera camera;
  camera.target = center;
  camera.distance = radius / std::sin(kFieldOfView / 2);
  return camera;
}

Camera camera_at(glm::vec3 eye, glm::vec3 target) {
  Camera camera;
  const glm::vec3 away = eye - target;
  camera.target = target;
  camera.distance = glm::length(away);
  camera.azimuth = std::atan2(away.y, away.x);
  camera.elevation = std::clamp(std::asin(away.z / camera.distance), -kSteepest, kSteepest);
  return camera;
}

std::optional<Camera> parse_camera(const std::string& text, const Camera& start) {
  const std::size_t colon = text.find(':');
  if (colon != std::string::npos) {
    const auto eye = numbers_of(text.substr(0, colon));
    const auto target = numbers_of(text.substr(colon + 1));
    if (eye.size() != 3 || target.size() != 3 || eye == target) return {};
    return camera_at({eye[0], eye[1], eye[2]}, {target[0], target[1], target[2]});
  }
  const auto angles = numbers_of(text);
  if (angles.size() < 2 || angles.size() > 3) return {};
  Camera camera = start;
  camera.azimuth = glm::radians(angles[0]);
  camera.elevation = std::clamp(glm::radians(angles[1]), -kSteepest, kSteepest);
  if (angles.size() == 3) {
    if (!(angles[2] > 0)) return {};
    camera.distance = angles[2];
  }
  return camera;
}

}  // namespace view
