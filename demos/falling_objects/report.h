// SPDX-License-Identifier: BSD-3-Clause
// What a run prints and writes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "falling_objects/options.h"
#include "judging/draping.h"
#include "simulation/step_record.h"

namespace falling_objects {

// One line that is rewritten on a terminal; elsewhere a line a simulated second.
class Progress {
 public:
  explicit Progress(const Options& options);
  void show(const StepRecord& record);
  void finish();

 private:
  bool quiet_;
  bool terminal_;
  int steps_;
  int every_;
  std::chrono::steady_clock::time_point start_, last_;
};

// Of the timed stages (dBatchStage...) as columns are named; "gather".
const char* stage_name(std::size_t stage);

struct Summary {
  std::string device;  // empty: no batch collider
  std::size_t lost_objects = 0;
  // What is open has no inside, and is left out of what is measured.
  bool measures_all = true, measures_any = true;
  Draping draping;  // at the end
  std::uint64_t hash = 0;
};

void print_report(std::ostream& out, const Options& options, const std::vector<StepRecord>& steps,
                  const Summary& summary);

void write_csv(std::ostream& out, const std::vector<StepRecord>& steps);

}  // namespace falling_objects
