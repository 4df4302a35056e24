// SPDX-License-Identifier: BSD-3-Clause
// A whole run, from the command line to the exit code.
#pragma once

#include "paper/options.h"

namespace paper {

int run(const Options& options);

}  // namespace paper
