// SPDX-License-Identifier: BSD-3-Clause
#include "ode/pass_stats.h"

namespace ode_ext {

void note_report(const StepReport& report, dBatchColliderStats& stats) {
  if (report.redone != 0) stats.status |= dBatchStatusRedone;
  stats.redone = report.redone;
  stats.synchronizations = report.synchronizations;
  stats.pairs_computed = static_cast<long long>(report.pairs);
  stats.pairs_bounded = static_cast<long long>(report.pairs_bounded);
  for (std::size_t i = 0; i < kArrowCount; ++i) {
    stats.predicted[i] = static_cast<long long>(report.predicted[i]);
    stats.actual[i] = static_cast<long long>(report.actual[i]);
    stats.capacity[i] = static_cast<long long>(report.capacity[i]);
  }
  if (report.missed != 0) stats.status |= dBatchStatusMissed;
  if (report.backtracked) stats.status |= dBatchStatusBacktracked;
  stats.missed = static_cast<long long>(report.missed);
  stats.iterative_unproven = static_cast<long long>(report.unproven);
  stats.dropped = static_cast<long long>(report.dropped);
  stats.temporal_pairs = static_cast<long long>(report.temporal_pairs);
  for (std::size_t i = 0; i < kWorkerCount; ++i) {
    const WorkCount& work = report.work[i];
    stats.work[i] = {static_cast<long long>(work.items), static_cast<long long>(work.units),
                     static_cast<long long>(work.lockstep32),
                     static_cast<long long>(work.lockstep64)};
  }
  static_assert(dBatchStageDeformStep + kStageCount == dBatchStageDevice);
  for (std::size_t i = 0; i < kStageCount; ++i) stats.ms[dBatchStageDeformStep + i] = report.ms[i];
  stats.ms[dBatchStageDevice] = report.ms_total;
}

}  // namespace ode_ext
