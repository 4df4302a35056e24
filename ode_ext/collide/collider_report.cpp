// SPDX-License-Identifier: BSD-3-Clause
// What a batch took, and what the next one may go by.
#include "collide/collider.h"

namespace ode_ext {

StageTimes Collider::take_milliseconds() {
  StageTimes ms{};
  add_time(ms, Stage::kDeformStep, data_.meshes);
  search_.take_milliseconds(ms);
  assembly_.take_milliseconds(ms);
  if (whole_step_) add_time(ms, Stage::kWholeStep, *whole_step_);
  if (paper_) paper_->take_milliseconds(ms);
  return ms;
}

void Collider::finish(Batch& batch) {
  report_.capacity = data_.lists.capacities();
  report_.temporal_pairs = batch.remembers() ? batch.memory->temporal->pairs() : 0;
  report_.ms = take_milliseconds();
  data_.lists.note_use(report_.actual, batch.memory != nullptr);
  if (batch.memory == nullptr) return;
  batch.memory->history = {report_.pairs, report_.actual, report_.appended, report_.left};
  // A little more each time: what did not fit once may have been short of memory for a moment.
  std::size_t& tile_pairs = batch.memory->tile_pairs;
  if (!report_.given_up.empty()) tile_pairs = batch.tile_pairs;  // no size helped
  if (tile_pairs != 0 && tile_pairs < report_.pairs) tile_pairs += tile_pairs / 16 + 1;
}

}  // namespace ode_ext
