// SPDX-License-Identifier: BSD-3-Clause
// Whoever watches a run, and changes nothing of it.
#pragma once

#include <functional>
#include <memory>
#include <ostream>

#include "falling_objects/world.h"
#include "simulation/step_record.h"

namespace falling_objects {

class Spectator {
 public:
  virtual ~Spectator() = default;
  virtual void after_step(const StepRecord& record) = 0;
  // After the last step. Says what came of it.
  virtual void finish(std::ostream& out) = 0;
};

// Of a world that has not moved yet; null where nobody wants to watch.
using MakeSpectator = std::function<std::unique_ptr<Spectator>(const World&)>;

}  // namespace falling_objects
