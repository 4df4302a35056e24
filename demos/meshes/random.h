// SPDX-License-Identifier: BSD-3-Clause
// Random numbers that are the same with every standard library: std::mt19937_64 is specified to the
// bit, the standard's distributions are not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

namespace falling_objects {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // In [0, 1): the upper 53 bits, as many as a double holds.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  // In [0, count).
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(unit() * static_cast<double>(count));
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace falling_objects
