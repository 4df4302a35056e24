// SPDX-License-Identifier: BSD-3-Clause
// Hashes as they are printed.
#pragma once

#include <cstdint>
#include <string>

namespace paper {

inline std::string hex(std::uint64_t hash) {
  std::string text(16, '0');
  for (std::size_t i = text.size(); i-- > 0; hash >>= 4) text[i] = "0123456789abcdef"[hash & 15];
  return text;
}

}  // namespace paper
