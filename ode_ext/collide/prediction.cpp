// SPDX-License-Identifier: BSD-3-Clause
#include "collide/prediction.h"

#include <cmath>

namespace ode_ext {

ListCounts predict(const History& history, std::uint64_t pairs, PredictionRule rule,
                   double confidence) {
  double scale = confidence;
  if (rule == PredictionRule::kPairScaled && history.pairs != 0)
    scale *= static_cast<double>(pairs) / static_cast<double>(history.pairs);
  ListCounts predicted{};
  for (std::size_t i = 0; i < kListCount; ++i) {
    // 2^40 entries exceed every device; the limit keeps the conversion defined.
    const double value = std::ceil(static_cast<double>(history.counts[i]) * scale);
    predicted[i] = static_cast<std::uint64_t>(std::fmin(std::fmax(value, 1.0), 0x1p40));
  }
  return predicted;
}

}  // namespace ode_ext
