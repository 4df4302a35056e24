// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/append_lists.h"

#include <algorithm>

namespace ode_ext {
namespace {

static_assert(static_cast<std::size_t>(Arrow::kChunksSmall) == OX_LIST_CHUNKS_SMALL &&
              static_cast<std::size_t>(Arrow::kRaysIterative) == OX_LIST_RAYS_ITERATIVE &&
              static_cast<std::size_t>(Arrow::kRaysEdges) == OX_LIST_RAYS_EDGES &&
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
      crossings_(device),
      gathered_crossings_(device),
      crossing_order_(device),
      contacts_(device) {
  counters_.reserve(kCounterBytes);
  lists_.reserve(sizeof(host_lists_));
}

void AppendLists::reserve(const ArrowCounts& counts) {
  for (std::size_t i = 0; i < kArrowCount; ++i)
    if (counts[i] > capacities_[i])
      capacities_[i] = std::min(counts[i] + counts[i] / 4, std::max(kMostRecords, counts[i]));
  reserve_buffers();
}

void AppendLists::limit(const ArrowCounts& counts) {
  capacities_ = counts;
  reserve_buffers();
}

AppendLists::Ends AppendLists::lay_out(const ArrowCounts& room) {
  const auto after = [&](Arrow first, Arrow last) {
    std::uint64_t end = 0;
    for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
      host_lists_[i] = {static_cast<ox_u32>(end), static_cast<ox_u32>(room[i])};
      end += room[i];
    }
    return end;
  };
  return {after(Arrow::kChunksSmall, Arrow::kChunksEdges),
          after(Arrow::kRaysIterative, Arrow::kRaysEdges), after(Arrow::kHits, Arrow::kHits),
          after(Arrow::kCrossings, Arrow::kCrossings), after(Arrow::kContacts, Arrow::kContacts)};
}

void AppendLists::reserve_buffers() {
  const Ends ends = lay_out(capacities_);
  tasks_.reserve(ends.tasks * sizeof(ox_chunk_task));
  rays_.reserve(ends.rays * sizeof(ox_ray));
  hits_.reserve(ends.hits * sizeof(ox_hit));
  candidates_.reserve((ends.hits + OX_POINTS_PER_CROSSING * ends.crossings) * sizeof(ox_candidate));
  crossings_.reserve(ends.crossings * sizeof(ox_edge_crossing));
  gathered_crossings_.reserve(ends.crossings * sizeof(ox_edge_crossing));
  crossing_order_.reserve(2 * ends.crossings * sizeof(ox_u32));
  contacts_.reserve(ends.contacts * sizeof(ox_contact));
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

void AppendLists::begin(const ArrowCounts& most) {
  ArrowCounts room{};
  for (std::size_t i = 0; i < kArrowCount; ++i) room[i] = std::min(capacities_[i], most[i]);
  lay_out(room);
  counters_.fill_zero(kCounterBytes);
  lists_.write(host_lists_.data(), sizeof(host_lists_));
}

}  // namespace ode_ext
