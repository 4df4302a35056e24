// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "paper/work_count.h"
#include "search/list.h"
#include "search/stage.h"

namespace ode_ext {

// The kernels whose work is counted on demand. In the order of work_of (ode/pass_stats).
enum class CountedKernel : std::size_t {
  kVertexStep,
  kIterativeRays,
  kBvhRays,
  kBasicRays,
  kMonolithic
};
inline constexpr std::size_t kCountedKernelCount = 5;

// What the last batch took.
struct BatchReport {
  std::uint64_t pairs = 0;
  std::uint64_t pairs_bounded = 0;               // whose bounding volumes overlap
  ListCounts predicted{}, actual{}, capacity{};  // [records], all tiles together
  ListCounts appended{};                         // of those, not in shares (kernels/whole_step.cl)
  std::uint64_t left = 0;                        // pairs that did not fit into a share
  int redone = 0;
  int synchronizations = 0;
  bool backtracked = false;  // nothing was delivered
  // Pairs of the scene that the device has no room for, each by itself, while it has for others:
  // their ranges are empty and say nothing. Why, of the last.
  std::vector<std::size_t> given_up;
  std::string why_given_up;
  std::uint64_t missed = 0;    // entries that were lost
  std::uint64_t unproven = 0;  // iterative rays that were cast in full after all
  std::uint64_t dropped = 0;   // vertices dropped for want of temporal data
  std::uint64_t temporal_pairs = 0;
  std::array<WorkCount, kCountedKernelCount> work{};
  StageTimes ms{};
  double milliseconds(Stage stage) const { return ms[static_cast<std::size_t>(stage)]; }
  double ms_total = 0;  // host clock, first upload to last read-back
};

}  // namespace ode_ext
