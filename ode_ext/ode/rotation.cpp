// SPDX-License-Identifier: BSD-3-Clause
#include "ode/rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/vec.h"

namespace ode_ext {
namespace {

// What the roundings of a product of rotations in double precision leave. The device has a rotation
// to 2^-48, and turns distances of kilometres by it.
constexpr double kNotWorthTurning = 1e-14;

Vec3d row(const Matrix& matrix, std::size_t i) {
  return {matrix[3 * i], matrix[3 * i + 1], matrix[3 * i + 2]};
}

Vec3d unit(Vec3d v) { return (1 / length(v)) * v; }

}  // namespace

double off_rotation(const Matrix& matrix) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double off = std::fabs(dot(row(matrix, i), row(matrix, j)) - (i == j ? 1 : 0));
      if (!std::isfinite(off)) return kInfinity;
      most = std::max(most, off);
    }
  const bool mirrors = dot(cross(row(matrix, 0), row(matrix, 1)), row(matrix, 2)) < 0;
  return mirrors ? kInfinity : most;
}

Matrix nearest_rotation(const Matrix& matrix) {
  const double off = off_rotation(matrix);
  if (off <= kNotWorthTurning || !(off <= kMostOff)) return matrix;
  const Vec3d x = unit(row(matrix, 0));
  const Vec3d y = unit(row(matrix, 1) - dot(row(matrix, 1), x) * x);
  const Vec3d z = cross(x, y);
  return {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z};
}

}  // namespace ode_ext
