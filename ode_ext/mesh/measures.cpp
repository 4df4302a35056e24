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

float vector_area_share(const std::vector<Vec3f>& vertices,
                        const std::vector<Triangle>& triangles) {
  Vec3d vector_area{};
  double area = 0;
  for (const Triangle& triangle : triangles) {
    const Vec3d a(vertices[triangle[0]]);
    const Vec3d twice = cross(Vec3d(vertices[triangle[1]]) - a, Vec3d(vertices[triangle[2]]) - a);
    vector_area = vector_area + twice;
    area += length(twice);
  }
  return area > 0 ? static_cast<float>(length(vector_area) / area) : 1;
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
