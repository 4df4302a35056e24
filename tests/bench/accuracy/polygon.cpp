// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_GEOMETRY_NO_ROBUSTNESS  // else it rounds corners to a grid
#include "bench/accuracy/polygon.h"

#include <algorithm>
#include <boost/geometry/algorithms/intersection.hpp>
#include <cmath>
#include <limits>
#include <vector>

namespace ode_ext::accuracy {
namespace {

// How far the deepest corner of `other` is on the inner side of an edge.
double deepest_below(const Polygon& polygon, std::size_t edge, const Polygon& other) {
  const Point2 &p = polygon[edge], &q = polygon[(edge + 1) % polygon.size()];
  const double dx = q.x() - p.x(), dy = q.y() - p.y(), length = std::hypot(dx, dy);
  double depth = -std::numeric_limits<double>::infinity();
  for (const Point2& r : other)
    depth = std::max(depth, (dx * (r.y() - p.y()) - dy * (r.x() - p.x())) / length);
  return depth;
}

}  // namespace

Polygon square(double side, const Point2& centre, double yaw) {
  Polygon corners;
  const double c = std::cos(yaw) * side / 2, s = std::sin(yaw) * side / 2;
  for (const Point2 sign : {Point2{-1, -1}, Point2{1, -1}, Point2{1, 1}, Point2{-1, 1}}) {
    corners.push_back(
        {centre.x() + sign.x() * c - sign.y() * s, centre.y() + sign.x() * s + sign.y() * c});
  }
  return corners;
}

Polygon intersection(const Polygon& a, const Polygon& b) {
  std::vector<Polygon> common;
  boost::geometry::intersection(a, b, common);
  return common.empty() ? Polygon{} : common.front();
}

double least_sideways(const Polygon& a, const Polygon& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i) least = std::min(least, deepest_below(a, i, b));
  for (std::size_t i = 0; i < b.size(); ++i) least = std::min(least, deepest_below(b, i, a));
  return least;
}

}  // namespace ode_ext::accuracy
