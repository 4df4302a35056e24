// SPDX-License-Identifier: BSD-3-Clause
// What was captured beside what was replayed, byte for byte.
#pragma once

#include <cstdint>
#include <string>

#include "tools/replay/capture_file.h"
#include "tools/replay/player.h"

namespace ode_ext::replay {

inline constexpr std::uint64_t kHashStart = 0xcbf29ce484222325;

// Mixes the number of contacts of each pair and every bit of every contact, in order.
std::uint64_t mix(std::uint64_t hash, const std::vector<std::uint32_t>& counts,
                  const std::vector<capture::Contact>& contacts);

// How many pairs differ, and a sentence about the first of them ("" if none does).
struct Difference {
  std::uint32_t pairs = 0;
  std::string first;
};

Difference compare(const PassRecord& pass, const ContactsRecord& captured, const Played& played);

}  // namespace ode_ext::replay
