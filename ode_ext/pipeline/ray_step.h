// SPDX-License-Identifier: BSD-3-Clause
// kernels/ray_step.cl: rays -> hits, one kernel per algorithm.
#pragma once

#include "device/program.h"
#include "pipeline/launch.h"
#include "pipeline/step_data.h"
#include "pipeline/temporal_cache.h"

namespace ode_ext {

class RayStep {
 public:
  RayStep(Program& program, const char* kernel) : kernel_(program, kernel) {}

  void run(Launch launch, const StepData& data, const TemporalCache& temporal,
           const Buffer& works) {
    const auto& [meshes, pairs, lists, settings] = data;
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(), lists.rays(),
                   pairs.pairs, meshes.records(), meshes.vertices(), meshes.triangles(),
                   meshes.meshlets(), meshes.meshlet_nodes(), settings.rays_mode,
                   settings.walk_limit, temporal.now(), pairs.hits, lists.hits(), works);
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
