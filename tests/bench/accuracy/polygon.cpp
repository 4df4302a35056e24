// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_ext::accuracy {
namespace {

constexpr double kSame = 1e-9;

// A line along an edge of a polygon; what is left of it is inside.
struct Line {
  Point2 from, outward;  // unit
  double above(const Point2& p) const {
    return outward[0] * (p[0] - from[0]) + outward[1] * (p[1] - from[1]);
  }
};

Line line_along(const Polygon& polygon, std::size_t edge) {
  const Point2 &p = polygon[edge], &q = polygon[(edge + 1) % polygon.size()];
  const double dx = q[0] - p[0], dy = q[1] - p[1], l = std::hypot(dx, dy);
  return {p, {dy / l, -dx / l}};
}

void add_corner(Polygon& polygon, const Point2& p) {
  for (const Point2& q : polygon) {
    if (std::hypot(p[0] - q[0], p[1] - q[1]) < kSame) return;
  }
  polygon.push_back(p);
}

// What is below the line (Sutherland and Hodgman 1974).
Polygon cut(const Polygon& polygon, const Line& line) {
  Polygon rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double hp = line.above(p), hq = line.above(q);
    if (hp <= 0) add_corner(rest, p);
    if ((hp < 0 && hq > 0) || (hp > 0 && hq < 0)) {
      const double s = hp / (hp - hq);
      add_corner(rest, {p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])});
    }
  }
  return rest.size() < 3 ? Polygon{} : rest;
}

double deepest_below(const Polygon& polygon, const Line& line) {
  double depth = -std::numeric_limits<double>::infinity();
  for (const Point2& p : polygon) depth = std::max(depth, -line.above(p));
  return depth;
}

}  // namespace

Polygon square(double side, const Point2& centre, double yaw) {
  Polygon corners;
  const double c = std::cos(yaw) * side / 2, s = std::sin(yaw) * side / 2;
  for (const Point2 sign : {Point2{-1, -1}, Point2{1, -1}, Point2{1, 1}, Point2{-1, 1}}) {
    corners.push_back(
        {centre[0] + sign[0] * c - sign[1] * s, centre[1] + sign[0] * s + sign[1] * c});
  }
  return corners;
}

Polygon intersection(const Polygon& a, const Polygon& b) {
  Polygon rest = a;
  for (std::size_t i = 0; i < b.size() && !rest.empty(); ++i) rest = cut(rest, line_along(b, i));
  return rest;
}

double least_sideways(const Polygon& a, const Polygon& b) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i)
    least = std::min(least, deepest_below(b, line_along(a, i)));
  for (std::size_t i = 0; i < b.size(); ++i)
    least = std::min(least, deepest_below(a, line_along(b, i)));
  return least;
}

}  // namespace ode_ext::accuracy
