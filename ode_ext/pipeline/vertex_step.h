// SPDX-License-Identifier: BSD-3-Clause
// kernels/vertex_step.cl: chunk tasks -> rays.
#pragma once

#include "device/program.h"
#include "pipeline/append_buffer.h"
#include "pipeline/device_meshes.h"
#include "pipeline/launch.h"

namespace ode_ext {

class VertexStep {
 public:
  explicit VertexStep(Program& program) : kernel_(program, "vertex_step") {}

  void run(Launch launch, const Buffer& counters, const AppendBuffer& tasks, const Buffer& pairs,
           const DeviceMeshes& meshes, const AppendBuffer& rays) {
    kernel_.launch(launch.groups, launch.local, counters, tasks.records(), tasks.capacity(), pairs,
                   meshes.records(), meshes.chunks(), meshes.vertices(), meshes.grids(),
                   rays.records(), rays.capacity());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
