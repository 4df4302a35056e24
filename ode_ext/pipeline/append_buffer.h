// SPDX-License-Identifier: BSD-3-Clause
// An append buffer: records in device memory behind a counter that runs on past the capacity.
#pragma once

#include <algorithm>
#include <cstdint>

#include "device/buffer.h"

namespace ode_ext {

class AppendBuffer {
 public:
  AppendBuffer(Device& device, std::size_t record_bytes)
      : record_bytes_(record_bytes), records_(device) {}

  // Room for at least `records`; a quarter more when it has to grow, so that it rarely does.
  void reserve(std::uint64_t records) {
    if (records <= capacity_) return;
    capacity_ = 0;
    // Counters and capacities have 32 bits; tiles are cut so that nothing needs more.
    const std::uint64_t wanted = std::min<std::uint64_t>(records + records / 4, UINT32_MAX);
    records_.reserve(wanted * record_bytes_);
    capacity_ = static_cast<std::uint32_t>(wanted);
  }

  std::uint32_t capacity() const { return capacity_; }  // [records]
  std::size_t record_bytes() const { return record_bytes_; }
  const Buffer& records() const { return records_; }

 private:
  std::size_t record_bytes_;
  Buffer records_;
  std::uint32_t capacity_ = 0;
};

}  // namespace ode_ext
