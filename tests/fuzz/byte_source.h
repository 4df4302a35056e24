// SPDX-License-Identifier: BSD-3-Clause
// Numbers out of a fuzzer's bytes. Every choice costs one byte or a few, in order, so that changing
// a byte changes one thing; past the end all is zero.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <span>

namespace ode_ext::fuzz {

class ByteSource {
 public:
  explicit ByteSource(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool empty() const { return bytes_.empty(); }

  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }
  // In [0, n); n from 1 to 256.
  int below(int n) { return byte() % n; }
  // In [lo, hi]
  int between(int lo, int hi) { return lo + below(hi - lo + 1); }
  bool coin() { return (byte() & 1) != 0; }

  // Multiples of 1/64 from -1.75 to 1.73: few enough that things meet exactly, now and then.
  double lattice() { return lattice_of(byte()); }
  // In (0, 2]: a size.
  double size() { return (byte() + 1) / 128.0; }
  // Any number at all, seldom an awkward one: a lattice number, four raw bytes, or one of the list.
  double wild() {
    constexpr double kAwkward[] = {std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity(),
                                   -0.0,
                                   1e-45,
                                   1e-38,
                                   -1e-30,
                                   1e-22,
                                   1e-10,
                                   1e-6,
                                   1e3,
                                   -1e6,
                                   1e7,
                                   1e10,
                                   1e13,
                                   -1e16,
                                   1e19,
                                   1e20,
                                   1e30,
                                   -3e38,
                                   1e39,
                                   1e300};
    const std::uint8_t choice = byte();
    if (choice < 224) return lattice_of(choice);
    if (choice >= 224 + std::size(kAwkward)) return raw_float();
    return kAwkward[choice - 224];
  }

 private:
  static double lattice_of(std::uint8_t byte) { return (byte % 224 - 112) / 64.0; }

  double raw_float() {
    std::uint8_t bytes[4];
    for (std::uint8_t& b : bytes) b = byte();
    float value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }

  std::span<const std::uint8_t> bytes_;
};

}  // namespace ode_ext::fuzz
