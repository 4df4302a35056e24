// SPDX-License-Identifier: BSD-3-Clause
#include "paper/schedule.h"

#include <algorithm>

namespace paper {

std::vector<std::size_t> order_in(int step, std::size_t count) {
  std::vector<std::size_t> order(count);
  const std::size_t first = static_cast<std::size_t>(step / 2);
  for (std::size_t i = 0; i < count; ++i) order[i] = (first + i) % count;
  if (step % 2 != 0) std::reverse(order.begin(), order.end());
  return order;
}

bool is_measured(int step, int every) { return (step + 1) % every == 0; }

bool is_measured_or_warming_up(int step, int every) {
  return every - 1 - step % every <= kWarmUpSteps;
}

}  // namespace paper
