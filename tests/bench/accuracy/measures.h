// SPDX-License-Identifier: BSD-3-Clause
// What is counted: shares, percentiles, angles.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/points.h"

namespace ode_ext::accuracy {

// Between 0 and 180 degrees; right for small angles too, where an arc cosine is not.
inline double degrees_between(const test::Point& a, const test::Point& b) {
  return std::atan2(test::length(test::cross(a, b)), test::dot(a, b)) * 180 / std::numbers::pi;
}

// Not a number exceeds everything: no error may hide behind one.
inline bool exceeds(double value, double limit) { return !(value <= limit); }

// How many of how many.
struct Share {
  long long hits = 0, all = 0;

  void count(bool hit) {
    hits += hit;
    ++all;
  }
  double percent() const {  // of nothing: 0
    return all > 0 ? 100 * static_cast<double>(hits) / static_cast<double>(all) : 0;
  }
};

// The least value that at least `percent` per cent do not exceed (nearest rank); of nothing: 0.
inline double percentile(std::vector<double> values, double percent) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(percent / 100 * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

inline double worst(const std::vector<double>& values) { return percentile(values, 100); }

inline double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

}  // namespace ode_ext::accuracy
