// SPDX-License-Identifier: BSD-3-Clause
// A time line of the passes for chrome://tracing and Perfetto, written where ODE_EXT_TRACE says.
#pragma once

#include <chrono>

#include "ode/pass_stats.h"

namespace ode_ext {

// Opens the file that ODE_EXT_TRACE names, once per process; nothing if it is not set. Throws
// std::runtime_error with a sentence if it cannot be written.
void open_trace_of_environment();

// Appends a pass that began at `start`: its host stages one after another on one track, the kernels
// on another. Does nothing without a trace.
void trace_pass(std::chrono::steady_clock::time_point start, const PassStats& stats);

}  // namespace ode_ext
