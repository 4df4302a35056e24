// SPDX-License-Identifier: BSD-3-Clause
// Which configuration collides when.
#pragma once

#include <cstddef>
#include <vector>

namespace paper {

// The places of `count` configurations in a step. Everyone is first, second, ... equally often, and
// follows either neighbour equally often: whoever comes later finds warm caches.
std::vector<std::size_t> order_in(int step, std::size_t count);

// What is slow is measured in the last of every `every` steps only. Before that its collider takes
// part in two steps without being measured: iterative rays start from what the step before left
// behind, and predictions from its counts.
inline constexpr int kWarmUpSteps = 2;
bool is_measured(int step, int every);
bool is_measured_or_warming_up(int step, int every);

}  // namespace paper
