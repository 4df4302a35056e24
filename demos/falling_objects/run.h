// SPDX-License-Identifier: BSD-3-Clause
// A whole run, from the command line to the exit code.
#pragma once

#include "falling_objects/options.h"
#include "falling_objects/spectator.h"

namespace falling_objects {

// `watch` may be empty.
int run(const Options& options, const MakeSpectator& watch = {});

}  // namespace falling_objects
