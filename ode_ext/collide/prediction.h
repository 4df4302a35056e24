// SPDX-License-Identifier: BSD-3-Clause
// Predicting how many entries an append buffer will get (GRAPP section 4.1).
#pragma once

#include <cstdint>

#include "search/list.h"

namespace ode_ext {

enum class PredictionRule { kPairScaled, kPlain };

// What the last pass of the same kind (the same space) truly produced.
struct History {
  std::uint64_t pairs = 0;
  ListCounts counts{};
  ListCounts appended{};   // of those, not in shares of the lists (kernels/whole_step.cl)
  std::uint64_t left = 0;  // pairs that did not fit into one
};

// Eq. 1 (pair-scaled) or Eq. 2 (plain) for a pass of `pairs` pairs, rounded up; at least 1. Where
// the last pass had no pairs Eq. 1 has no ratio to scale by, and the last counts stand as they are.
ListCounts predict(const History& history, std::uint64_t pairs, PredictionRule rule,
                   double confidence);

}  // namespace ode_ext
