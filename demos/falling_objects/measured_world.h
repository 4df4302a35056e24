// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "falling_objects/world.h"
#include "judging/penetration.h"

namespace falling_objects {

// A world of which it is measured every 0.1 s how deep its objects are in one another.
class MeasuredWorld {
 public:
  // As World.
  explicit MeasuredWorld(const Options& options, bool both_colliders = false)
      : world_(options, both_colliders), meter_(world_.scene()) {}

  StepRecord step();
  World& world() { return world_; }

 private:
  World world_;
  PenetrationMeter meter_;
};

// The same start for ODE's own collider. Throws UsageError where that cannot be.
Options options_beside(const Options& options);

}  // namespace falling_objects
