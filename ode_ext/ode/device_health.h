// SPDX-License-Identifier: BSD-3-Clause
// How often a device failed in a row. After a driver was reset nothing works that was made before:
// what goes on failing is made anew, ever more rarely.
#pragma once

namespace ode_ext {

class DeviceHealth {
 public:
  void note_failure() { ++failures_; }
  void note_success() { *this = {}; }
  int failures() const { return failures_; }
  // True once after 8 failures in a row, once after 16, and so on.
  bool is_to_be_made_anew() {
    if (failures_ < next_) return false;
    if (next_ < kLargest) next_ *= 2;
    return true;
  }

 private:
  static constexpr int kLargest = 1 << 20;
  int failures_ = 0;
  int next_ = 8;
};

}  // namespace ode_ext
