// SPDX-License-Identifier: BSD-3-Clause
// A whole run, from the command line to the exit code.
#pragma once

#include "falling_objects/options.h"
#include "falling_objects/spectator.h"

namespace falling_objects {

// `watch` may be empty.
int run(const Options& options, const MakeSpectator& watch = {});

// The same for something else to do with ODE: `show` returns an exit code.
int run_window(const Options& options, const std::function<int(const Options&)>& show);

}  // namespace falling_objects
