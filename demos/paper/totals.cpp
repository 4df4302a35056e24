// SPDX-License-Identifier: BSD-3-Clause
#include "paper/totals.h"

namespace paper {

void Totals::add(const dBatchColliderStats& stats, bool settled) {
  ++steps;
  redone += stats.redone > 0;
  if (!settled) return;
  iterative_rays += stats.actual[dBatchBufferRaysIterative];
  unproven += stats.iterative_unproven;
  bvh_rays += stats.actual[dBatchBufferRaysBvh];
  iterative_ms += stats.ms[dBatchStageIterativeRays];
  bvh_ms += stats.ms[dBatchStageBvhRays];
}

}  // namespace paper
