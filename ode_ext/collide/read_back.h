// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "opencl/buffer.h"
#include "search/batch_data.h"

namespace ode_ext {

// The contacts of a tile on their way to the host.
class ReadBack {
 public:
  explicit ReadBack(Device& device) : device_(device), ranges_(device), contacts_(device) {}

  // Before the first launch of an attempt: host memory for all that it may give.
  void reserve(const BatchData& data);
  // After the last: the contacts of each pair, as many in all as are expected, and what was
  // counted. Waits.
  void read(BatchData& data, std::uint64_t expected);
  // Those that were not expected, if there are any.
  void read_rest(const BatchData& data);

  std::span<const ox_range> ranges(const BatchData& data) const {
    return {static_cast<const ox_range*>(ranges_.data()), data.pairs.count};
  }
  std::span<const ox_contact> contacts(const BatchData& data) const {
    return {static_cast<const ox_contact*>(contacts_.data()), data.lists.length(List::kContacts)};
  }

 private:
  void read_contacts(const BatchData& data, std::uint64_t count);

  Device& device_;
  HostView ranges_, contacts_;
  std::uint64_t read_ = 0;  // of the contacts
};

}  // namespace ode_ext
