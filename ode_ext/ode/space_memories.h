// SPDX-License-Identifier: BSD-3-Clause
// What each space's last pass left for its next one. Spaces come and go unannounced, so everything
// here ages, and what takes device memory ages soonest.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>

#include "collide/pass_memory.h"
#include "ode/pair_gather.h"

namespace ode_ext {

class SpaceMemories {
 public:
  // What the last pass of this root left. If no pair of this pass is known, neither to the caller
  // (`familiar`) nor from that pass, this is another space at an address that ODE has used again,
  // which inherits nothing.
  PassMemory& of(const PassRoot& root, std::uint64_t pass, bool familiar,
                 std::span<const GatheredPair> pairs);
  // Forgets what has not been used for long, and temporal data beyond `most_bytes`, the longest
  // unused first, but never those of pass number `pass`.
  void prune(std::uint64_t pass, std::size_t most_bytes);

  void clear() { memories_.clear(); }
  std::size_t size() const { return memories_.size(); }
  std::size_t temporal_bytes() const;  // of device memory

 private:
  using GeomPair = std::array<dGeomID, 2>;
  struct Entry {
    PassMemory memory;
    std::uint64_t last_pass = 0;
    // Some of its pairs, by which it is known again when their answers are forgotten.
    std::array<GeomPair, 4> sample{};

    bool knows(std::span<const GatheredPair> pairs) const;
    void remember(std::span<const GatheredPair> pairs);
  };

  std::map<PassRoot, Entry, RootLess> memories_;
};

}  // namespace ode_ext
