// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/history.h"

#include <algorithm>
#include <numeric>

namespace falling_objects {

const std::array<const char*, kParts> kPartNames{"gather", "meshes",         "device",
                                                 "export", "ODE's own pass", "world step"};

void History::add(const World& world, const StepRecord& record) {
  Moment moment;
  dBatchColliderID batch = world.collision().batch();
  double in_batch = 0;
  if (batch != nullptr && world.options().collider == Collider::kBatch) {
    const std::array<int, 4> stages{dBatchStageGather, dBatchStageMeshes, dBatchStageDevice,
                                    dBatchStageExport};
    for (std::size_t i = 0; i < stages.size(); ++i) {
      moment.ms[i] = dBatchColliderGetTime(batch, stages[i]);
      in_batch += moment.ms[i];
    }
    moment.redone = (record.status & dBatchStatusRedone) != 0;
  }
  moment.ms[4] = std::max(0.0, record.collide_ms - in_batch);
  moment.ms[5] = record.world_ms;
  moments_.push_back(moment);
  if (moments_.size() > kLength) moments_.pop_front();
}

double History::longest() const {
  double longest = 0;
  for (const Moment& moment : moments_) {
    longest = std::max(longest, std::accumulate(moment.ms.begin(), moment.ms.end(), 0.0));
  }
  return longest;
}

bool History::redone_lately(double hz) const {
  const auto count = std::min(moments_.size(), static_cast<std::size_t>(std::max(1.0, hz / 2)));
  return std::any_of(moments_.end() - static_cast<std::ptrdiff_t>(count), moments_.end(),
                     [](const Moment& moment) { return moment.redone; });
}

}  // namespace falling_objects
