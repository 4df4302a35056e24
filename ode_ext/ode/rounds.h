// SPDX-License-Identifier: BSD-3-Clause
// The time by which what is known ages. A program may collide many spaces in turn, each once or
// several times, or a space with each of many geoms: what it knows of one is as fresh when it comes
// back to it as if that were the only one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>

#include "ode/pair_gather.h"

namespace ode_ext {

// A round is no longer than this. A program that makes a space for every pass would never end it,
// nor one whose spaces go; and what a round may bring is kept for several.
inline constexpr std::size_t kPassesInARound = 1024;
inline constexpr std::size_t kPairsInARound = std::size_t{1} << 18;

class Rounds {
 public:
  // A pass that gathered so many pairs. A round ends where a root comes again that was in it, and
  // all roots of the round before have come.
  void note_pass(const PassRoot& root, std::size_t pairs) {
    if ((missing_.empty() && roots_.contains(root)) || passes_ >= kPassesInARound ||
        pairs_ >= kPairsInARound)
      end();
    roots_.insert(root);
    missing_.erase(root);
    ++passes_;
    pairs_ += pairs;
  }
  void end() {
    ++number_;
    passes_ = pairs_ = 0;
    missing_ = std::exchange(roots_, {});
  }
  std::uint64_t number() const { return number_; }

 private:
  std::set<PassRoot, RootLess> roots_;    // of this round
  std::set<PassRoot, RootLess> missing_;  // of the round before
  std::size_t passes_ = 0, pairs_ = 0;    // of this round
  std::uint64_t number_ = 1;
};

}  // namespace ode_ext
