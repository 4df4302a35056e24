// SPDX-License-Identifier: BSD-3-Clause
// The trials: each runs with the contacts of ode_ext, of ODE's own mesh collider and, where the
// bodies are boxes, of ODE's box geoms, and prints the three beside each other.
#pragma once

#include <cstdint>

#include "bench/stability/report.h"

namespace ode_ext::stability {

struct TrialOptions {
  std::uint64_t seed = 1;
  bool quick = false;  // shorter and fewer: does it work, not how well
  int max_contacts = 16;
  int objects = 1000;  // of `settled`
  int steps = 600;
};

void run_towers(const TrialOptions& options, Report& report);
void run_slope(const TrialOptions& options, Report& report);
void run_slide(const TrialOptions& options, Report& report);
void run_throws(const TrialOptions& options, Report& report);
void run_rest(const TrialOptions& options, Report& report);
void run_terrain(const TrialOptions& options, Report& report);
void run_settled(const TrialOptions& options, Report& report);

// A line on stderr: what is being run.
void say(const char* format, ...) __attribute__((format(printf, 1, 2)));

}  // namespace ode_ext::stability
