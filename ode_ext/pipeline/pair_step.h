// SPDX-License-Identifier: BSD-3-Clause
// kernels/pair_step.cl: pairs -> chunk tasks, by category.
#pragma once

#include "device/program.h"
#include "pipeline/launch.h"
#include "pipeline/step_data.h"
#include "pipeline/temporal_cache.h"

namespace ode_ext {

class PairStep {
 public:
  explicit PairStep(Program& program) : kernel_(program, "pair_step") {}

  // dense: a task for every chunk of every pair, at its own place; those of PairBuffers.
  void run(Launch launch, const StepData& data, const TemporalCache& temporal, bool dense) {
    const auto& [meshes, pairs, lists, settings] = data;
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(), pairs.objects,
                   meshes.records(), meshes.chunks(), pairs.members, temporal.links(), pairs.count,
                   temporal.step(), settings.rays_mode, settings.displacement_limit,
                   temporal.poses(), temporal.directory(), pairs.pairs, pairs.hits, pairs.crossings,
                   pairs.heads, pairs.ranges, cl_uint{dense}, pairs.dense_first, lists.tasks());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
