// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "mesh/vec.h"

namespace ode_ext {

using Segment = std::array<Vec3d, 2>;
using Corners = std::array<Vec3d, 3>;

// Whether the segment runs through the triangle. What meets only its rim, or touches it only with
// an end, may go either way.
inline bool crosses(const Segment& segment, const Corners& triangle) {
  const Vec3d normal = cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  const double start = dot(normal, segment[0] - triangle[0]);
  const double end = dot(normal, segment[1] - triangle[0]);
  if (!((start < 0 && end > 0) || (start > 0 && end < 0))) return false;
  const Vec3d place = segment[0] + (start / (start - end)) * (segment[1] - segment[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d edge = triangle[(k + 1) % 3] - triangle[k];
    if (dot(cross(normal, edge), place - triangle[k]) < 0) return false;
  }
  return true;
}

}  // namespace ode_ext
