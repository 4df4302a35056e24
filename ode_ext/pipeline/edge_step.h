// SPDX-License-Identifier: BSD-3-Clause
// kernels/edge_step.cl, and the kernel of ray_step.cl for edges: chunk tasks -> rays -> crossings.
#pragma once

#include "device/program.h"
#include "pipeline/append_lists.h"
#include "pipeline/device_meshes.h"
#include "pipeline/launch.h"
#include "pipeline/pair_buffers.h"

namespace ode_ext {

class EdgeStep {
 public:
  explicit EdgeStep(Program& program) : kernel_(program, "edge_step") {}

  void run(Launch launch, AppendLists& lists, const DeviceMeshes& meshes, const PairBuffers& pairs,
           const Buffer& works) {
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(), lists.tasks(),
                   pairs.pairs, meshes.records(), meshes.chunks(), meshes.edges(), meshes.grids(),
                   lists.rays(), works);
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

class EdgeRayStep {
 public:
  explicit EdgeRayStep(Program& program) : kernel_(program, "ray_edges") {}

  void run(Launch launch, const AppendLists& lists, const DeviceMeshes& meshes,
           const PairBuffers& pairs, const Buffer& works) {
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(), lists.rays(),
                   pairs.pairs, meshes.records(), meshes.vertices(), meshes.edges(), meshes.nodes(),
                   meshes.triangles(), pairs.crossings, lists.crossings(), works);
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
