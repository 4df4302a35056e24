// SPDX-License-Identifier: BSD-3-Clause
// kernels/monolithic.cl: all chunks of all pairs -> hits.
#pragma once

#include "device/program.h"
#include "pipeline/launch.h"
#include "pipeline/step_data.h"
#include "pipeline/temporal_cache.h"

namespace ode_ext {

class MonolithicStep {
 public:
  explicit MonolithicStep(Program& program) : kernel_(program, "monolithic") {}

  // All chunks of the pairs, at the places that PairStep gave them.
  void run(Launch launch, const StepData& data, const TemporalCache& temporal,
           const Buffer& works) {
    const auto& [meshes, pairs, lists, settings] = data;
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(), lists.tasks(),
                   pairs.chunks, pairs.pairs, meshes.records(), meshes.chunks(), meshes.vertices(),
                   meshes.triangles(), meshes.meshlets(), meshes.meshlet_nodes(),
                   settings.rays_mode, settings.displacement_limit, settings.walk_limit,
                   temporal.before(), temporal.now(), pairs.hits, lists.hits(), works);
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
