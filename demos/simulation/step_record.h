// SPDX-License-Identifier: BSD-3-Clause
// What is kept of a step: a row of the CSV file.
#pragma once

#include <ode_ext/ode_ext.h>

#include <vector>

namespace falling_objects {

// The timed stages of the library (dBatchStage...), in their order.
inline const std::vector<int>& stages() {
  static const std::vector<int> all = [] {
    std::vector<int> found;
    for (int s = dBatchStageNext(-1); s >= 0; s = dBatchStageNext(s)) found.push_back(s);
    return found;
  }();
  return all;
}

struct StepRecord {
  int step = 0;
  long long pairs = 0;
  long long colliding_pairs = 0;
  long long contacts = 0;
  long long rays = 0;
  unsigned status = 0;           // dBatchStatus... bits
  double collide_ms = 0;         // the driving collider, callbacks included
  double world_ms = 0;           // contact joints and solver
  double solver_ms = 0;          // dWorldQuickStep alone
  std::vector<double> stage_ms;  // of stages()
  // Only with --compare: both colliders at the same poses.
  double batch_ms = 0, ode_ms = 0;
  long long batch_contacts = 0, ode_contacts = 0;

  // Only with sheets.
  long long sheet_contacts = 0;
  double cloth_ms = 0;                              // moving them, without colliding them
  double fastest_vertex = 0;                        // of a sheet [m/s]
  double deepest_vertex = -1, crossing_share = -1;  // as the oracle says [m]; negative: as below

  double mean_speed = 0;            // [m/s]
  double deepest_contact = 0;       // [m], as the collider says
  double deepest_penetration = -1;  // [m], as the oracle says; negative: not measured in this step
};

}  // namespace falling_objects
