// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/append_lists.h"

#include <algorithm>

namespace ode_ext {
namespace {

static_assert(static_cast<std::size_t>(Arrow::kChunksSmall) == OX_LIST_CHUNKS_SMALL &&
              static_cast<std::size_t>(Arrow::kRaysIterative) == OX_LIST_RAYS_ITERATIVE &&
              static_cast<std::size_t>(Arrow::kHits) == OX_LIST_HITS &&
              kArrowCount == OX_LIST_COUNT);

// Counters and indices have 32 bits; tiles are cut so that nothing needs more.
constexpr std::uint64_t kMostRecords = std::uint64_t{1} << 30;

}  // namespace

AppendLists::AppendLists(Device& device)
    : counters_(device),
      lists_(device),
      tasks_(device),
      rays_(device),
      hits_(device),
      candidates_(device),
      contacts_(device) {
  counters_.reserve(kCounterBytes);
  lists_.reserve(sizeof(host_lists_));
}

void AppendLists::reserve(const ArrowCounts& counts) {
  for (std::size_t i = 0; i < kArrowCount; ++i)
    if (counts[i] > capacities_[i])
      capacities_[i] = std::min(counts[i] + counts[i] / 4, std::max(kMostRecords, counts[i]));
  lay_out();
}

void AppendLists::limit(const ArrowCounts& counts) {
  capacities_ = counts;
  lay_out();
}

void AppendLists::lay_out() {
  const auto after = [&](Arrow first, Arrow last) {
    std::uint64_t end = 0;
    for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
      host_lists_[i] = {static_cast<ox_u32>(end), static_cast<ox_u32>(capacities_[i])};
      end += capacities_[i];
    }
    return end;
  };
  tasks_.reserve(after(Arrow::kChunksSmall, Arrow::kChunksDeformable) * sizeof(ox_chunk_task));
  rays_.reserve(after(Arrow::kRaysIterative, Arrow::kRaysBasic) * sizeof(ox_ray));
  const std::uint64_t hits = after(Arrow::kHits, Arrow::kHits);
  hits_.reserve(hits * sizeof(ox_hit));
  candidates_.reserve(hits * sizeof(ox_candidate));
  contacts_.reserve(after(Arrow::kContacts, Arrow::kContacts) * sizeof(ox_contact));
}

bool AppendLists::overflowed(const ArrowCounts& counts) const {
  for (std::size_t i = 0; i < kArrowCount; ++i)
    if (counts[i] > capacities_[i]) return true;
  return false;
}

std::uint64_t AppendLists::task_capacity() const {
  return std::uint64_t{host_lists_[OX_LIST_CHUNKS_DEFORMABLE].first} +
         host_lists_[OX_LIST_CHUNKS_DEFORMABLE].capacity;
}

void AppendLists::begin() {
  counters_.fill_zero(kCounterBytes);
  lists_.write(host_lists_.data(), sizeof(host_lists_));
}

}  // namespace ode_ext
