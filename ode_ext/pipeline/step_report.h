// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "pipeline/prediction.h"
#include "pipeline/work_count.h"

namespace ode_ext {

// The kernels whose work is counted on demand. The order is public (dBatchKernel...).
enum class Worker : std::size_t { kVertexStep, kIterativeRays, kBvhRays, kBasicRays, kMonolithic };
inline constexpr std::size_t kWorkerCount = 5;

// What the last step did.
struct StepReport {
  std::uint64_t pairs = 0;
  std::uint64_t pairs_bounded = 0;                // whose bounding volumes overlap
  ArrowCounts predicted{}, actual{}, capacity{};  // [records], all tiles together
  int redone = 0;
  int synchronizations = 0;
  bool backtracked = false;    // nothing was delivered
  std::uint64_t missed = 0;    // entries that were lost
  std::uint64_t unproven = 0;  // iterative rays that were cast in full after all
  std::uint64_t dropped = 0;   // vertices dropped for want of temporal data
  std::uint64_t temporal_pairs = 0;
  std::array<WorkCount, kWorkerCount> work{};
  double ms_deform_step = 0, ms_pair_step = 0, ms_vertex_step = 0, ms_iterative_rays = 0,
         ms_bvh_rays = 0, ms_basic_rays = 0, ms_monolithic = 0, ms_cull = 0, ms_match = 0,
         ms_cross = 0, ms_flood = 0, ms_edge_contacts = 0, ms_contact_step = 0;  // device
  double ms_total = 0;  // host clock, first upload to last read-back
};

}  // namespace ode_ext
