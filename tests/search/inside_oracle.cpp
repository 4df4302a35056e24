// SPDX-License-Identifier: BSD-3-Clause
#include "search/inside_oracle.h"

#include <numbers>

namespace ode_ext::test {

bool InsideOracle::is_inside(const Point& p) const {
  double halves = 0;
  for (const auto& corner : corners_) {
    const Point a = corner[0] - p, b = corner[1] - p, c = corner[2] - p;
    const double la = length(a), lb = length(b), lc = length(c);
    halves += std::atan2(dot(a, cross(b, c)),
                         la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return halves > std::numbers::pi;
}

}  // namespace ode_ext::test
