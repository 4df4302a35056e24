// SPDX-License-Identifier: BSD-3-Clause
// Oriented boxes and their separating axes, plainly and in double precision.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "support/test_scene.h"

namespace ode_ext::test {

// Centre, unit axes, half sizes along them.
struct OrientedBox {
  Point centre;
  std::array<Point, 3> axes;
  Point half;
};

inline OrientedBox oriented_box(const Box& box, const TestPose& pose, const Point& origin) {
  const Point lo = point_of(box.lo), hi = point_of(box.hi);
  OrientedBox result;
  result.centre = rotate(pose, 0.5 * (lo + hi)) + (pose.position - origin);
  for (std::size_t k = 0; k < 3; ++k) {
    Point axis{};
    axis[k] = 1;
    result.axes[k] = rotate(pose, axis);
    result.half[k] = 0.5 * (hi[k] - lo[k]);
  }
  return result;
}

// How far apart the boxes are along an axis of any length, in multiples of that length.
inline double gap_along(const OrientedBox& a, const OrientedBox& b, const Point& axis) {
  double gap = std::fabs(dot(axis, a.centre - b.centre));
  for (std::size_t k = 0; k < 3; ++k)
    gap -=
        a.half[k] * std::fabs(dot(axis, a.axes[k])) + b.half[k] * std::fabs(dot(axis, b.axes[k]));
  return gap;
}

// The largest gap along the 15 axes of the separating axis theorem; edge axes are not normalised,
// as in the kernel, so that near-parallel edges say little.
inline double gap_between(const OrientedBox& a, const OrientedBox& b) {
  double gap = -INFINITY;
  for (std::size_t i = 0; i < 3; ++i) {
    gap = std::max({gap, gap_along(a, b, a.axes[i]), gap_along(a, b, b.axes[i])});
    for (std::size_t j = 0; j < 3; ++j)
      gap = std::max(gap, gap_along(a, b, cross(a.axes[i], b.axes[j])));
  }
  return gap;
}

// The rays of an open mesh that meet another open one may leave its box, as far as this [m].
inline double reach_of_pair(const TestScene& scene, std::size_t pair) {
  double reach = 0;
  for (const std::size_t side : {0u, 1u}) {
    if (scene.built_mesh_of(pair, side).closed()) return 0;
    for (const float exit : scene.built_mesh_of(pair, side).exits)
      if (std::isfinite(exit)) reach = std::max(reach, double{exit});
  }
  return reach;
}

// [m]; negative where the boxes of the two meshes overlap, or are within reach of their rays.
inline double gap_of_pair(const TestScene& scene, std::size_t pair) {
  const Point& origin = scene.pose_of(pair, 1).position;
  return gap_between(oriented_box(box_as_given(scene.built_mesh_of(pair, 0)),
                                  scene.pose_of(pair, 0), origin),
                     oriented_box(box_as_given(scene.built_mesh_of(pair, 1)),
                                  scene.pose_of(pair, 1), origin)) -
         reach_of_pair(scene, pair);
}

}  // namespace ode_ext::test
