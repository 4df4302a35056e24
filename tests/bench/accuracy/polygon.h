// SPDX-License-Identifier: BSD-3-Clause
// Convex polygons in the plane: where two squares overlap, seen from above.
#pragma once

#include <array>
#include <vector>

namespace ode_ext::accuracy {

using Point2 = std::array<double, 2>;
using Polygon = std::vector<Point2>;  // counter-clockwise

Polygon square(double side, const Point2& centre, double yaw);

// Empty where the two do not overlap. Corners closer than 1e-9 of each other are one.
Polygon intersection(const Polygon& a, const Polygon& b);

// How far one of two overlapping polygons has to go within the plane until they touch (the least
// overlap along the normal of any edge); negative where they are apart.
double least_sideways(const Polygon& a, const Polygon& b);

}  // namespace ode_ext::accuracy
