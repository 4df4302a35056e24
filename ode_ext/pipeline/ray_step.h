// SPDX-License-Identifier: BSD-3-Clause
// kernels/ray_step.cl: rays -> hits.
#pragma once

#include "device/program.h"
#include "pipeline/append_buffer.h"
#include "pipeline/device_meshes.h"
#include "pipeline/launch.h"

namespace ode_ext {

class RayStep {
 public:
  explicit RayStep(Program& program) : kernel_(program, "ray_step") {}

  void run(Launch launch, const Buffer& counters, const AppendBuffer& rays, const Buffer& pairs,
           const DeviceMeshes& meshes, const Buffer& pair_hits, const AppendBuffer& hits) {
    kernel_.launch(launch.groups, launch.local, counters, rays.records(), rays.capacity(), pairs,
                   meshes.records(), meshes.vertices(), meshes.nodes(), meshes.triangles(),
                   pair_hits, hits.records(), hits.capacity());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
