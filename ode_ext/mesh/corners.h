// SPDX-License-Identifier: BSD-3-Clause
// The corners of a triangle, and how thin it is.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "mesh/triangle.h"
#include "mesh/vec.h"

namespace ode_ext {

// Of a coordinate, how far off a corner may be: each of the three is rounded by 2^-24 of itself at
// most, all of them by less than two of these, and by as much again by the program that gave them.
inline constexpr double kCornerRounding = 0x1p-22;

using Corners = std::array<Vec3d, 3>;

inline Corners corners_of(const std::vector<Vec3f>& vertices, const Triangle& triangle) {
  return {Vec3d(vertices[triangle[0]]), Vec3d(vertices[triangle[1]]), Vec3d(vertices[triangle[2]])};
}

inline double longest_side(const Corners& t) {
  return std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
}

// Over the longest side; not a number where all corners are at one place.
inline double height(const Corners& t) {
  return length(cross(t[1] - t[0], t[2] - t[0])) / longest_side(t);
}

}  // namespace ode_ext
