// SPDX-License-Identifier: BSD-3-Clause
#include "ode/space_memories.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace ode_ext {
namespace {

// Temporal data are void in any pass of their space but the next, so they only wait for the spaces
// that a program collides in turn. A history is a hundred bytes and spares a pass run twice.
constexpr std::uint64_t kPassesOfTemporalData = 32;
constexpr std::uint64_t kPassesOfHistory = 1024;

std::size_t bytes_of(const PassMemory& memory) {
  return memory.temporal == nullptr ? 0 : memory.temporal->bytes();
}

}  // namespace

bool SpaceMemories::Entry::knows(std::span<const GatheredPair> pairs) const {
  return std::ranges::any_of(pairs, [&](const GatheredPair& pair) {
    return std::ranges::find(sample, GeomPair{pair.first.geom, pair.second.geom}) != sample.end();
  });
}

void SpaceMemories::Entry::remember(std::span<const GatheredPair> pairs) {
  if (pairs.empty()) return;  // nothing that was met before was forgotten
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const GatheredPair& pair = pairs[i * (pairs.size() - 1) / (sample.size() - 1)];
    sample[i] = {pair.first.geom, pair.second.geom};
  }
}

PassMemory& SpaceMemories::of(const PassRoot& root, std::uint64_t pass, bool familiar,
                              std::span<const GatheredPair> pairs) {
  Entry& entry = memories_[root];
  if (!familiar && !entry.knows(pairs)) entry.memory = {};
  entry.remember(pairs);
  entry.last_pass = pass;
  return entry.memory;
}

void SpaceMemories::prune(std::uint64_t pass, std::size_t most_bytes) {
  std::erase_if(memories_,
                [&](const auto& item) { return item.second.last_pass + kPassesOfHistory < pass; });
  std::vector<Entry*> holders;
  for (auto& [root, entry] : memories_)
    if (entry.memory.temporal != nullptr) holders.push_back(&entry);
  std::sort(holders.begin(), holders.end(),
            [](const Entry* a, const Entry* b) { return a->last_pass < b->last_pass; });
  std::size_t bytes = temporal_bytes();
  for (Entry* entry : holders) {
    if (entry->last_pass == pass) break;
    if (entry->last_pass + kPassesOfTemporalData >= pass && bytes <= most_bytes) break;
    bytes -= bytes_of(entry->memory);
    entry->memory.temporal.reset();
  }
}

std::size_t SpaceMemories::temporal_bytes() const {
  std::size_t bytes = 0;
  for (const auto& [root, entry] : memories_) bytes += bytes_of(entry.memory);
  return bytes;
}

}  // namespace ode_ext
