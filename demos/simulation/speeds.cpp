// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/speeds.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace falling_objects {

std::vector<double> speeds(const Scene& scene) {
  std::vector<double> result;
  for (const Object& object : scene.objects()) {
    if (!can_move(object)) continue;
    const dReal* v = dBodyGetLinearVel(object.body);
    result.push_back(std::hypot(v[0], v[1], v[2]));
  }
  return result;
}

double mean(const std::vector<double>& values) {
  if (values.empty()) return 0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0;
  const double last = static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::llround(fraction * last));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace falling_objects
