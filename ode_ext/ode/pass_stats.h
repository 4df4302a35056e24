// SPDX-License-Identifier: BSD-3-Clause
// What the last pass did, and the one table of what of it is public, by value and name.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "collide/batch_report.h"
#include "ode_ext/ode_ext.h"

namespace ode_ext {

// Since the collider was created.
struct Totals {
  std::int64_t pairs_batched = 0;  // computed in batches
  std::int64_t asked = 0;          // dCollide of two meshes, as far as this library answered
  std::int64_t asked_colliding = 0, contacts_given = 0;
  double ms_passes = 0;  // of the batches, without ODE's own passes and the callbacks

  int note_answer(int contacts) {
    ++asked;
    asked_colliding += contacts > 0 ? 1 : 0;
    contacts_given += contacts;
    return contacts;
  }
};

struct PassStats {
  unsigned status = 0;  // dBatchStatus... bits
  BatchReport report;   // of the last batch
  std::int64_t pairs = 0, pairs_computed = 0, pairs_colliding = 0, deformed = 0;
  std::int64_t passes = 0, pairs_alone = 0, pairs_stock = 0, meshes = 0;  // since creation
  Totals totals;
  double ms_gather = 0, ms_meshes = 0, ms_device = 0, ms_export = 0, ms_pass = 0;

  // The end of the batch.
  void sum_up() {
    totals.pairs_batched += pairs_computed;
    totals.ms_passes += ms_pass;
  }
  // Another batch within the pass, after its own.
  void count_more(std::int64_t computed) {
    pairs_computed += computed;
    totals.pairs_batched += computed;
  }
};

// Takes over what the pipeline reports.
void note_report(const BatchReport& report, PassStats& stats);

// A timed stage. Those on the host follow one another, but for the pass, which holds them all;
// those on the device are within dBatchStageDevice.
struct TimedStage {
  enum Track { kWhole, kHost, kDevice };
  int value;
  const char* name;
  Track track;
  double (*milliseconds)(const PassStats&);
};
std::span<const TimedStage> timed_stages();  // ascending by value

struct Counter {
  int value;
  std::string name;
  std::int64_t (*read)(const PassStats&, std::size_t index);
  std::size_t index;  // of the buffer
};
const std::vector<Counter>& counters();  // ascending by value

// The work of a stage that is counted, or null.
const WorkCount* work_of(const PassStats& stats, int stage);

}  // namespace ode_ext
