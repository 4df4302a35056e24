// SPDX-License-Identifier: BSD-3-Clause
// A whole run, from the command line to the exit code.
#pragma once

#include "falling_objects/options.h"

namespace falling_objects {

int run(const Options& options);

}  // namespace falling_objects
