// SPDX-License-Identifier: BSD-3-Clause
// kernels/monolithic.cl: all chunks of all pairs -> hits.
#pragma once

#include "device/program.h"
#include "pipeline/append_lists.h"
#include "pipeline/device_meshes.h"
#include "pipeline/launch.h"
#include "pipeline/pair_buffers.h"
#include "pipeline/step_settings.h"
#include "pipeline/temporal_cache.h"

namespace ode_ext {

class MonolithicStep {
 public:
  explicit MonolithicStep(Program& program) : kernel_(program, "monolithic") {}

  void run(Launch launch, AppendLists& lists, cl_uint task_count, const DeviceMeshes& meshes,
           const PairBuffers& pairs, const TemporalCache& temporal, const StepSettings& settings,
           const Buffer& works) {
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(), lists.tasks(),
                   task_count, pairs.pairs, meshes.records(), meshes.chunks(), meshes.vertices(),
                   meshes.grids(), meshes.nodes(), meshes.triangles(), meshes.isolations(),
                   settings.rays_mode, settings.displacement_limit, settings.walk_limit,
                   temporal.before(), temporal.now(), pairs.hits, lists.hits(), works);
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
