// SPDX-License-Identifier: BSD-3-Clause
// The time by which what is known ages. A program may collide many spaces in turn, or a space with
// each of many geoms: what it knows of one is as fresh when it comes back to it as if that were the
// only one.
#pragma once

#include <cstdint>
#include <set>

#include "ode/pair_gather.h"

namespace ode_ext {

// Passes within one round, where none of them is of a root that was there: a program that makes a
// space for every pass would never end it.
inline constexpr std::size_t kPassesInARound = 1024;

class Rounds {
 public:
  // A round ends where a root comes again.
  void note_pass(const PassRoot& root) {
    if (roots_.size() < kPassesInARound && roots_.insert(root).second) return;
    ++number_;
    roots_ = {root};
  }
  std::uint64_t number() const { return number_; }

 private:
  std::set<PassRoot, RootLess> roots_;  // of this round
  std::uint64_t number_ = 1;
};

}  // namespace ode_ext
