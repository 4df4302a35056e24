// SPDX-License-Identifier: BSD-3-Clause
// The files that variables of the environment name, and processes write as long as they live.
#pragma once

#include <cstdio>

namespace ode_ext {

// The file that a variable names, emptied; null: it names none. A program may start others, which
// have its environment: where another process is writing that file, this one's has its number added
// to the name, which is logged. Throws std::runtime_error with a sentence.
std::FILE* open_output_of_environment(const char* variable);

}  // namespace ode_ext
