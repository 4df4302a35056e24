// SPDX-License-Identifier: BSD-3-Clause
// Creation parameters, checked and translated.
#pragma once

#include <string>

#include "collide/options.h"
#include "ode_ext/ode_ext.h"

namespace ode_ext::api {

// Those of a caller that may have been compiled with an older, shorter struct: its part over the
// defaults, which is all of it where there is none. Throws where anything is out of range.
dBatchColliderParams complete(const dBatchColliderParams* given);

ColliderOptions to_options(const dBatchColliderParams& params);

// What the program selects, else what the environment does.
std::string selection_or_environment(const char* selection);

}  // namespace ode_ext::api
