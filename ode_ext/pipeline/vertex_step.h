// SPDX-License-Identifier: BSD-3-Clause
// kernels/vertex_step.cl: chunk tasks -> rays, one kernel per category of pairs.
#pragma once

#include <array>

#include "device/program.h"
#include "pipeline/launch.h"
#include "pipeline/step_data.h"
#include "pipeline/temporal_cache.h"

namespace ode_ext {

class VertexStep {
 public:
  explicit VertexStep(Program& program)
      : kernels_{{{program, "vertex_small"},
                  {program, "vertex_high"},
                  {program, "vertex_deformable"}}} {}

  void run(Arrow category, Launch launch, const StepData& data, const TemporalCache& temporal,
           const Buffer& works) {
    const auto& [meshes, pairs, lists, settings] = data;
    kernels_[static_cast<std::size_t>(category)].launch(
        launch.groups, launch.local, lists.counters(), lists.lists(), lists.tasks(), pairs.pairs,
        meshes.records(), meshes.chunks(), meshes.vertices(), settings.rays_mode,
        settings.displacement_limit, temporal.before(), temporal.now(), lists.rays(), works);
  }
  double take_milliseconds() {
    double sum = 0;
    for (Kernel& kernel : kernels_) sum += kernel.take_milliseconds();
    return sum;
  }

 private:
  std::array<Kernel, 3> kernels_;
};

}  // namespace ode_ext
