// SPDX-License-Identifier: BSD-3-Clause
// kernels/cull.cl, match.cl, cross.cl: pairs -> meshlets -> pairs of meshlets -> crossings.
#pragma once

#include "device/program.h"
#include "pipeline/append_lists.h"
#include "pipeline/device_meshes.h"
#include "pipeline/launch.h"
#include "pipeline/pair_buffers.h"

namespace ode_ext {

class CullStep {
 public:
  explicit CullStep(Program& program) : kernel_(program, "cull") {}

  void run(Launch launch, const AppendLists& lists, const DeviceMeshes& meshes,
           const PairBuffers& pairs) {
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(), pairs.pairs,
                   meshes.records(), meshes.meshlet_nodes(), pairs.count, lists.meshlets());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

class MatchStep {
 public:
  explicit MatchStep(Program& program) : kernel_(program, "match") {}

  void run(Launch launch, const AppendLists& lists, const DeviceMeshes& meshes,
           const PairBuffers& pairs) {
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(), lists.meshlets(),
                   pairs.pairs, meshes.records(), meshes.meshlets(), meshes.meshlet_nodes(),
                   lists.meshlet_pairs(), pairs.crossings, lists.crossings());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

class CrossStep {
 public:
  explicit CrossStep(Program& program) : kernel_(program, "cross_meshlets") {}

  void run(Launch launch, const AppendLists& lists, const DeviceMeshes& meshes,
           const PairBuffers& pairs) {
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(),
                   lists.meshlet_pairs(), pairs.pairs, meshes.meshlets(), pairs.crossings,
                   lists.crossings());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
