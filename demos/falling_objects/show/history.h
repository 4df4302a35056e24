// SPDX-License-Identifier: BSD-3-Clause
// What the last steps took, for a chart that rolls.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <string>

#include "falling_objects/world.h"

namespace falling_objects {

// Parts of a step that follow one another [ms].
inline constexpr std::size_t kParts = 6;
extern const std::array<const char*, kParts> kPartNames;

struct Moment {
  std::array<double, kParts> ms{};
  bool redone = false;  // buffers were too small
};

class History {
 public:
  static constexpr std::size_t kLength = 180;  // steps

  // Right after the step.
  void add(const World& world, const StepRecord& record);
  void clear() { moments_.clear(); }

  const std::deque<Moment>& moments() const { return moments_; }
  double longest() const;  // step of these [ms]
  // In the last half second.
  bool redone_lately(double hz) const;

 private:
  std::deque<Moment> moments_;
};

}  // namespace falling_objects
