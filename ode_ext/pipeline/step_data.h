// SPDX-License-Identifier: BSD-3-Clause
// What the kernels of a step work on.
#pragma once

#include "device/program.h"
#include "pipeline/append_lists.h"
#include "pipeline/device_meshes.h"
#include "pipeline/pair_buffers.h"
#include "pipeline/step_settings.h"

namespace ode_ext {

struct StepData {
  explicit StepData(Program& program)
      : meshes(program), pairs(program.device()), lists(program.device()) {}

  DeviceMeshes meshes;
  PairBuffers pairs;
  AppendLists lists;
  StepSettings settings;
};

}  // namespace ode_ext
