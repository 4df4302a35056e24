// SPDX-License-Identifier: BSD-3-Clause
#include "view/marks.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace view {

ShadedMesh arrow_mesh() {
  constexpr unsigned kSides = 10;
  constexpr float kNeck = 0.62F, kShaft = 0.4F;
  std::vector<glm::vec3> vertices;
  std::vector<unsigned> triangles;
  const auto add_ring = [&](float radius, float z) {
    for (unsigned i = 0; i < kSides; ++i) {
      const float angle = glm::two_pi<float>() * static_cast<float>(i) / kSides;
      vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  };
  // Rings of no radius close it at both ends; the triangles without area that this makes show
  // nothing.
  add_ring(0, 0);
  add_ring(kShaft, 0);
  add_ring(kShaft, kNeck);
  add_ring(1, kNeck);
  add_ring(0, 1);
  for (unsigned ring = 0; ring + 1 < 5; ++ring) {
    for (unsigned i = 0; i < kSides; ++i) {
      const unsigned j = (i + 1) % kSides, low = ring * kSides, high = low + kSides;
      triangles.insert(triangles.end(), {low + i, low + j, high + j, low + i, high + j, high + i});
    }
  }
  return shade(vertices, triangles);
}

Pose arrow_pose(const Arrow& arrow, float thickness) {
  const glm::vec3 along = arrow.to - arrow.from;
  const float length = glm::length(along);
  const glm::vec3 z = length > 0 ? along / length : glm::vec3(0, 0, 1);
  const glm::vec3 aside = std::abs(z.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  const glm::vec3 x = glm::normalize(glm::cross(aside, z));
  return Pose(thickness * x, thickness * glm::cross(z, x), length * z, arrow.from);
}

ShadedMesh box_mesh() {
  ShadedMesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.vertices.push_back({glm::vec3(i & 1U, (i >> 1U) & 1U, i >> 2U), glm::vec3(0, 0, 1)});
    for (unsigned bit = 1; bit < 8; bit *= 2) {
      if ((i & bit) == 0) mesh.triangles.insert(mesh.triangles.end(), {i, i | bit});
    }
  }
  return mesh;
}

}  // namespace view
