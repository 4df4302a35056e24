// SPDX-License-Identifier: BSD-3-Clause
// What work-items did, and what that costs where they run in lockstep: a group is busy until its
// last work-item is done, in one branch of the algorithm after the other.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "abi/paper.h"
#include "opencl/buffer.h"

namespace ode_ext {

struct WorkCount {
  std::uint64_t items = 0;
  std::uint64_t units = 0;       // about one box test each
  std::uint64_t lockstep32 = 0;  // that groups of 32 are busy for, over all their lanes
  std::uint64_t lockstep64 = 0;
};

// Adds the items of one launch, in the order in which they share groups.
void add_work(std::span<const ox_work> items, WorkCount& count);

// What the work-items of one launch after the other tell of themselves, where that is wanted.
class WorkRecords {
 public:
  WorkRecords(Device& device, bool wanted) : device_(&device), wanted_(wanted), buffer_(device) {}

  bool is_wanted() const { return wanted_; }
  // Room for those of the kernel to be launched; any kernel has room for one.
  void reserve(std::uint64_t items) { buffer_.reserve((wanted_ ? items : 1) * sizeof(ox_work)); }
  // Adds those of the kernel launched last; waits.
  void take(std::uint64_t items, WorkCount& count);
  const Buffer& buffer() const { return buffer_; }

 private:
  Device* device_;
  bool wanted_;
  Buffer buffer_;
  std::vector<ox_work> host_;
};

}  // namespace ode_ext
