// SPDX-License-Identifier: BSD-3-Clause
// In which order pairs are taken from a queue.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ode_ext {

// Those that take the longest first (Graham 1969, longest processing time), so that in the end no
// work-item has one left to do that takes long while others have none. How long a pair takes goes
// by its features: it is enough to know them to within a factor of two, and pairs of as many stay
// as they come. order: which comes first, which next; empty where they stay as they are.
void put_longest_first(std::span<const std::uint32_t> features, std::vector<std::uint32_t>& order);

}  // namespace ode_ext
