// SPDX-License-Identifier: BSD-3-Clause
// Three doubles and what tests do with them. Shares nothing with the library's own vectors, so that
// a mistake there cannot cancel out here.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace ode_ext::test {

using Point = std::array<double, 3>;

inline Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }
inline double distance(const Point& a, const Point& b) { return length(a - b); }

// The unit vector along a; zero for zero.
inline Point unit(const Point& a) {
  const double l = length(a);
  return l > 0 ? (1 / l) * a : Point{};
}

inline double largest_component(const Point& a) {
  return std::fmax(std::fabs(a[0]), std::fmax(std::fabs(a[1]), std::fabs(a[2])));
}

}  // namespace ode_ext::test
