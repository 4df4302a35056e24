// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "collide/prediction.h"
#include "paper/temporal_cache.h"

namespace ode_ext {

// What is kept from one pass to the next of the same space. Must not outlive the collider that
// filled it.
struct PassMemory {
  History history;
  std::unique_ptr<TemporalCache> temporal;  // of iterative rays
  // How many pairs to collide at a time since all at once did not fit the device; 0: they do.
  std::size_t tile_pairs = 0;
};

}  // namespace ode_ext
