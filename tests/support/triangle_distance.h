// SPDX-License-Identifier: BSD-3-Clause
// Distances of points, segments and triangles, squared [m^2].
#pragma once

#include <array>

#include "mesh/vec.h"

namespace ode_ext {

using Segment = std::array<Vec3d, 2>;
using Corners = std::array<Vec3d, 3>;

// Each is the distance of two points that do lie on the two shapes, to a few roundings (2^-50 of
// the coordinates).
double squared_distance(Vec3d point, const Segment& segment);
double squared_distance(Vec3d point, const Corners& triangle);

// Not too large by more than 2^-20 of the shorter segment, and that only if the two are parallel
// to within 2^-20.
double squared_distance(const Segment& a, const Segment& b);

// Whether the segment runs through the triangle. What meets only its rim, or touches it only with
// an end, may go either way.
bool crosses(const Segment& segment, const Corners& triangle);

}  // namespace ode_ext
