// SPDX-License-Identifier: BSD-3-Clause
// What work-items did, and what that costs where they run in lockstep: a group is busy until its
// last work-item is done, in one branch of the algorithm after the other.
#pragma once

#include <cstdint>
#include <span>

#include "shared/types.h"

namespace ode_ext {

struct WorkCount {
  std::uint64_t items = 0;
  std::uint64_t units = 0;       // about one box test each
  std::uint64_t lockstep32 = 0;  // that groups of 32 are busy for, over all their lanes
  std::uint64_t lockstep64 = 0;
};

// Adds the items of one launch, in the order in which they share groups.
void add_work(std::span<const ox_work> items, WorkCount& count);

}  // namespace ode_ext
