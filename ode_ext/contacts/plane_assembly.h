// SPDX-License-Identifier: BSD-3-Clause
// From crossings and vertices inside to contacts by separating planes: kernels/contacts.
#pragma once

#include "opencl/launch.h"
#include "opencl/program.h"
#include "search/batch_data.h"
#include "search/stage.h"

namespace ode_ext {

class PlaneAssembly {
 public:
  // of_groups: as in Search.
  PlaneAssembly(Program& program, Program& of_groups);

  // Features, regions and their planes, and candidates for contacts: features.cl, choose.cl. Of
  // each pair a few of them: reduce.cl, of a queue as regions are.
  void run(Launch per_pair, Launch per_feature, Launch per_region, const BatchData& data);

  // Adds the device time since the last call.
  void take_milliseconds(StageTimes& ms);

 private:
  Kernel gather_, place_, link_, join_, begin_, count_, place_regions_, fill_, propose_, choose_,
      reduce_;
};

}  // namespace ode_ext
