// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/triangle_box.h"

#include <algorithm>
#include <cmath>

namespace ode_ext {
namespace {

// Corners relative to the box's centre. A zero axis separates nothing.
bool separates(Vec3d axis, const std::array<Vec3d, 3>& corners, Vec3d half_size) {
  const double reach = std::fabs(axis.x) * half_size.x + std::fabs(axis.y) * half_size.y +
                       std::fabs(axis.z) * half_size.z;
  const double a = dot(axis, corners[0]);
  const double b = dot(axis, corners[1]);
  const double c = dot(axis, corners[2]);
  return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
}

}  // namespace

bool triangle_overlaps_box(const std::array<Vec3d, 3>& triangle, Vec3d box_centre,
                           Vec3d half_size) {
  constexpr std::array<Vec3d, 3> kBoxAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  const std::array<Vec3d, 3> corners{triangle[0] - box_centre, triangle[1] - box_centre,
                                     triangle[2] - box_centre};
  for (const Vec3d& axis : kBoxAxes) {
    if (separates(axis, corners, half_size)) return false;
  }
  const std::array<Vec3d, 3> edges{corners[1] - corners[0], corners[2] - corners[1],
                                   corners[0] - corners[2]};
  if (separates(cross(edges[0], edges[1]), corners, half_size)) return false;
  for (const Vec3d& edge : edges) {
    for (const Vec3d& axis : kBoxAxes) {
      if (separates(cross(axis, edge), corners, half_size)) return false;
    }
  }
  return true;
}

}  // namespace ode_ext
