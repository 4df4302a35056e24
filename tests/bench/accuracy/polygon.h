// SPDX-License-Identifier: BSD-3-Clause
// Convex polygons in the plane: where two squares overlap, seen from above.
#pragma once

#define BOOST_ALLOW_DEPRECATED_HEADERS  // which Boost.Geometry 1.74 includes itself
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/ring.hpp>

namespace ode_ext::accuracy {

using Point2 = boost::geometry::model::d2::point_xy<double>;
// Counter-clockwise; the first corner is not repeated.
using Polygon = boost::geometry::model::ring<Point2, false, false>;

Polygon square(double side, const Point2& centre, double yaw);

// Empty where the two do not overlap.
Polygon intersection(const Polygon& a, const Polygon& b);

// How far one of two overlapping polygons has to go within the plane until they touch (the least
// overlap along the normal of any edge); negative where they are apart.
double least_sideways(const Polygon& a, const Polygon& b);

}  // namespace ode_ext::accuracy
