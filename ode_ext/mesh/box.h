// SPDX-License-Identifier: BSD-3-Clause
// Axis-aligned boxes.
#pragma once

#include <limits>
#include <vector>

#include "mesh/vec.h"

namespace ode_ext {

struct Box {
  Vec3f lo, hi;
};

// Holds nothing; growing it by a point gives that point.
inline Box empty_box() {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
}

inline Box grown(const Box& box, Vec3f point) { return {min(box.lo, point), max(box.hi, point)}; }
inline Box grown(const Box& box, const Box& other) {
  return {min(box.lo, other.lo), max(box.hi, other.hi)};
}

// The tight box of the points; all zero if there are none.
inline Box box_of(const std::vector<Vec3f>& points) {
  if (points.empty()) return {};
  Box box = empty_box();
  for (const Vec3f& point : points) box = grown(box, point);
  return box;
}

// Halved before they are added, so that no finite box overflows.
inline Vec3f centre(const Box& box) { return 0.5f * box.lo + 0.5f * box.hi; }

inline Vec3d extent(const Box& box) { return Vec3d(box.hi) - Vec3d(box.lo); }

// Half of the surface [m^2].
inline double half_area(const Box& box) {
  const Vec3d size = extent(box);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

// By component the largest distance of a corner from the origin.
inline Vec3f farthest_corner(const Box& box) {
  return max(max(box.hi, Vec3f{} - box.hi), max(box.lo, Vec3f{} - box.lo));
}

}  // namespace ode_ext
