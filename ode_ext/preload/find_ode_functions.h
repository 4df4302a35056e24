// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace ode_ext {

// Finds all functions of ODE that this library calls. Before that none may be called.
// Returns the name of one that `find` does not know, else null.
const char* find_ode_functions(void* (*find)(const char* name));

}  // namespace ode_ext
