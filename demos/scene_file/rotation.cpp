// SPDX-License-Identifier: BSD-3-Clause
#include "scene_file/rotation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace falling_objects {

Point direction_of(const Point& axis) {
  const int exponent =
      std::ilogb(std::max({std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2])}));
  return {std::scalbn(axis[0], -exponent), std::scalbn(axis[1], -exponent),
          std::scalbn(axis[2], -exponent)};
}

Quaternion rotation_about(const Point& axis, double angle) {
  const double scale = std::sin(angle / 2) / std::hypot(axis[0], axis[1], axis[2]);
  return {std::cos(angle / 2), scale * axis[0], scale * axis[1], scale * axis[2]};
}

Quaternion product(const Quaternion& a, const Quaternion& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

Point rotate(const Quaternion& q, const Point& p) {
  const Quaternion r = product(product(q, {0, p[0], p[1], p[2]}), {q[0], -q[1], -q[2], -q[3]});
  return {r[1], r[2], r[3]};
}

Quaternion random_rotation(Random& random) {
  const double u = random.unit();
  const double a = 2 * std::numbers::pi * random.unit();
  const double b = 2 * std::numbers::pi * random.unit();
  const double r = std::sqrt(1 - u), s = std::sqrt(u);
  return {r * std::sin(a), r * std::cos(a), s * std::sin(b), s * std::cos(b)};
}

}  // namespace falling_objects
