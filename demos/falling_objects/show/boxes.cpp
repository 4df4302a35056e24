// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/boxes.h"

#include <algorithm>
#include <array>

#include "falling_objects/show/mesh_of_geom.h"

namespace falling_objects {
namespace {

constexpr view::Color kBox{0.25F, 0.28F, 0.35F};

}  // namespace

view::Box box_of(dGeomID geom) {
  std::array<dReal, 6> b{};
  dGeomGetAABB(geom, b.data());
  const std::array<dReal, 3> low{b[0], b[2], b[4]}, high{b[1], b[3], b[5]};
  return {to_glm(low.data()), to_glm(high.data()), kBox};
}

view::Box around(const std::vector<glm::vec3>& points) {
  if (points.empty()) return {glm::vec3(0), glm::vec3(0), kBox};
  view::Box all{points.front(), points.front(), kBox};
  for (const glm::vec3& point : points) {
    all.low = glm::min(all.low, point);
    all.high = glm::max(all.high, point);
  }
  return all;
}

view::Box around(const std::vector<view::Box>& boxes) {
  std::vector<glm::vec3> corners;
  for (const view::Box& box : boxes) corners.insert(corners.end(), {box.low, box.high});
  return around(corners);
}

float radius_of(const view::Box& box) {
  return std::max(0.1F, 0.55F * glm::length(box.high - box.low));
}

bool holds(const view::Box& outer, const view::Box& inner) {
  return glm::all(glm::greaterThan(inner.low, outer.low)) &&
         glm::all(glm::lessThan(inner.high, outer.high));
}

}  // namespace falling_objects
