// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pipeline/prediction.h"

namespace ode_ext {

// What the last step did.
struct StepReport {
  std::uint64_t pairs = 0;
  std::uint64_t pairs_bounded = 0;                // whose bounding volumes overlap
  ArrowCounts predicted{}, actual{}, capacity{};  // [records], all tiles together
  int redone = 0;
  int synchronizations = 0;
  double ms_pair_step = 0, ms_vertex_step = 0, ms_ray_step = 0, ms_contact_step = 0;  // device
  double ms_total = 0;  // host clock, first upload to last read-back
};

}  // namespace ode_ext
