// SPDX-License-Identifier: BSD-3-Clause
// kernels/ray_step.cl: rays -> hits, one kernel per algorithm.
#pragma once

#include "device/program.h"
#include "pipeline/append_lists.h"
#include "pipeline/device_meshes.h"
#include "pipeline/launch.h"
#include "pipeline/pair_buffers.h"
#include "pipeline/step_settings.h"
#include "pipeline/temporal_cache.h"

namespace ode_ext {

class RayStep {
 public:
  RayStep(Program& program, const char* kernel) : kernel_(program, kernel) {}

  void run(Launch launch, const AppendLists& lists, const DeviceMeshes& meshes,
           const PairBuffers& pairs, const TemporalCache& temporal, const StepSettings& settings,
           const Buffer& works) {
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(), lists.rays(),
                   pairs.pairs, meshes.records(), meshes.vertices(), meshes.nodes(),
                   meshes.triangles(), meshes.isolations(), settings.rays_mode, settings.walk_limit,
                   temporal.now(), pairs.hits, lists.hits(), works);
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
