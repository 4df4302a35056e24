// SPDX-License-Identifier: BSD-3-Clause
// kernels/pair_step.cl: pairs -> chunk tasks.
#pragma once

#include "device/program.h"
#include "pipeline/append_buffer.h"
#include "pipeline/device_meshes.h"
#include "pipeline/launch.h"

namespace ode_ext {

class PairStep {
 public:
  explicit PairStep(Program& program) : kernel_(program, "pair_step") {}

  void run(Launch launch, const Buffer& counters, const Buffer& objects, const DeviceMeshes& meshes,
           const Buffer& pair_objects, cl_uint pair_count, const Buffer& pairs,
           const Buffer& pair_hits, const Buffer& pair_ranges, const AppendBuffer& tasks) {
    kernel_.launch(launch.groups, launch.local, counters, objects, meshes.records(),
                   meshes.chunks(), meshes.grids(), pair_objects, pair_count, pairs, pair_hits,
                   pair_ranges, tasks.records(), tasks.capacity());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
