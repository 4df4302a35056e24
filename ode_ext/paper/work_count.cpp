// SPDX-License-Identifier: BSD-3-Clause
#include "paper/work_count.h"

#include <algorithm>

namespace ode_ext {
namespace {

std::uint64_t busy(std::span<const ox_work> items, std::size_t lanes) {
  std::uint64_t total = 0;
  for (std::size_t first = 0; first < items.size(); first += lanes) {
    ox_work longest{};
    for (const ox_work& item : items.subspan(first, std::min(lanes, items.size() - first))) {
      longest.vertex = std::max(longest.vertex, item.vertex);
      longest.iterative = std::max(longest.iterative, item.iterative);
      longest.bvh = std::max(longest.bvh, item.bvh);
      longest.basic = std::max(longest.basic, item.basic);
    }
    total +=
        lanes * (std::uint64_t{longest.vertex} + longest.iterative + longest.bvh + longest.basic);
  }
  return total;
}

}  // namespace

void add_work(std::span<const ox_work> items, WorkCount& count) {
  count.items += items.size();
  for (const ox_work& item : items)
    count.units += std::uint64_t{item.vertex} + item.iterative + item.bvh + item.basic;
  count.lockstep32 += busy(items, 32);
  count.lockstep64 += busy(items, 64);
}

void WorkRecords::take(std::uint64_t items, WorkCount& count) {
  host_.resize(items);
  buffer_.read(host_.data(), items * sizeof(ox_work));
  device_->finish();
  add_work(host_, count);
}

}  // namespace ode_ext
