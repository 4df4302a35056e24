// SPDX-License-Identifier: BSD-3-Clause
// What a run amounts to, for each configuration.
#pragma once

#include <cstddef>

#include "paper/contestant.h"
#include "paper/missed.h"

namespace paper {

// The first step of the last third, where the objects have come to rest.
inline int settled_from(int steps) { return steps - steps / 3; }

struct Totals {
  int steps = 0;
  int redone = 0;  // steps that were computed more than once
  // Of the settled part.
  long long iterative_rays = 0;
  long long unproven = 0;  // of those, cast by the BVH after all
  long long bvh_rays = 0;  // with the unproven
  double iterative_ms = 0, bvh_ms = 0;
  // Of the whole run, where something may be missed.
  Missed missed;

  void add(dBatchColliderID collider, bool settled);  // its last pass
};

}  // namespace paper
