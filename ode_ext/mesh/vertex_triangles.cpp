// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/vertex_triangles.h"

#include <numeric>

namespace ode_ext {

VertexTriangles::VertexTriangles(std::size_t vertex_count, const std::vector<Triangle>& triangles)
    : starts_(vertex_count + 1), triangles_(3 * triangles.size()) {
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t corner : triangle) ++starts_[corner + 1];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (const std::uint32_t corner : triangles[t]) triangles_[next[corner]++] = t;
}

}  // namespace ode_ext
