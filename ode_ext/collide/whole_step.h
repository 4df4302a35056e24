// SPDX-License-Identifier: BSD-3-Clause
// All steps from pairs to contacts in one launch: kernels/whole_step.cl, of a program built with it
// (kProgramOption).
#pragma once

#include "opencl/launch.h"
#include "opencl/program.h"
#include "search/batch_data.h"
#include "search/stage.h"

namespace ode_ext {

class WholeStep {
 public:
  static constexpr const char* kProgramOption = "-DOX_WHOLE_STEP";

  explicit WholeStep(Program& program) : kernel_(program, "whole_step") {}

  void run(Launch shares, const BatchData& data);

  // Adds the device time since the last call.
  void take_milliseconds(StageTimes& ms) { add_time(ms, Stage::kWholeStep, kernel_); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
