// SPDX-License-Identifier: BSD-3-Clause
#include "paper/totals.h"

namespace paper {

void Totals::add(dBatchColliderID collider, bool settled) {
  const auto count = [&](int counter) { return dBatchColliderGetCount(collider, counter); };
  ++steps;
  redone += count(dBatchCounterRedone) > 0;
  if (!settled) return;
  iterative_rays += count(dBatchBufferRaysIterative);
  unproven += count(dBatchCounterIterativeUnproven);
  bvh_rays += count(dBatchBufferRaysBvh);
  iterative_ms += dBatchColliderGetTime(collider, dBatchStageIterativeRays);
  bvh_ms += dBatchColliderGetTime(collider, dBatchStageBvhRays);
}

}  // namespace paper
