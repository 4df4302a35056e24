// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/origin.h"

#include <algorithm>
#include <cmath>

namespace ode_ext {

// Floats of which neither is more than twice the other differ exactly (Sterbenz 1974).
Vec3f exact_origin(const Box& box) {
  const Vec3f middle = centre(box);
  Vec3f origin;
  for (std::size_t k = 0; k < 3; ++k) {
    const float m = middle[k];
    const float near = std::min(std::fabs(box.lo[k]), std::fabs(box.hi[k]));
    const float far = std::max(std::fabs(box.lo[k]), std::fabs(box.hi[k]));
    const bool is_beside = box.lo[k] > 0 || box.hi[k] < 0;
    if (is_beside && 0.5f * std::fabs(m) <= near && 0.5f * far <= std::fabs(m)) origin[k] = m;
  }
  return origin;
}

}  // namespace ode_ext
