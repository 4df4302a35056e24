// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/measures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_ext {

float mean_side(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& triangle : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum += length(Vec3d(vertices[triangle[k]]) - Vec3d(vertices[triangle[(k + 1) % 3]]));
    }
  }
  if (triangles.empty()) return 0;
  return static_cast<float>(sum / (3 * static_cast<double>(triangles.size())));
}

float half_diagonal(const Box& box) {
  const Vec3d middle(centre(box));
  return rounded_up(length(max(Vec3d(box.hi) - middle, middle - Vec3d(box.lo))));
}

float rounded_up(double value) {
  const auto rounded = static_cast<float>(value);
  if (rounded >= value) return rounded;
  return std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

}  // namespace ode_ext
