// SPDX-License-Identifier: BSD-3-Clause
// kernels/cull.cl, match.cl, cross.cl, flood.cl: pairs -> meshlets -> pairs of meshlets ->
// crossings -> rays of the vertices inside.
#pragma once

#include "device/program.h"
#include "pipeline/launch.h"
#include "pipeline/step_data.h"

namespace ode_ext {

class CullStep {
 public:
  explicit CullStep(Program& program) : kernel_(program, "cull") {}

  void run(Launch launch, const StepData& data) {
    const auto& [meshes, pairs, lists, settings] = data;
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

  void run(Launch launch, const StepData& data) {
    const auto& [meshes, pairs, lists, settings] = data;
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(), lists.meshlets(),
                   pairs.pairs, meshes.records(), meshes.meshlets(), meshes.meshlet_nodes(),
                   settings.rays_mode, lists.meshlet_pairs(), pairs.crossings, lists.crossings(),
                   pairs.heads, lists.crossing_links());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

class CrossStep {
 public:
  explicit CrossStep(Program& program) : kernel_(program, "cross_meshlets") {}

  void run(Launch launch, const StepData& data) {
    const auto& [meshes, pairs, lists, settings] = data;
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(),
                   lists.meshlet_pairs(), pairs.pairs, meshes.records(), meshes.meshlets(),
                   settings.rays_mode, pairs.crossings, lists.crossings(), pairs.heads,
                   lists.crossing_links());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

class FloodStep {
 public:
  explicit FloodStep(Program& program) : kernel_(program, "flood") {}

  void run(Launch launch, const StepData& data) {
    const auto& [meshes, pairs, lists, settings] = data;
    kernel_.launch(launch.groups, launch.local, lists.counters(), lists.lists(), pairs.pairs,
                   meshes.records(), meshes.chunks(), pairs.heads, lists.crossings(),
                   lists.crossing_links(), meshes.vertices(), meshes.edges(), meshes.ring_starts(),
                   meshes.rings(), meshes.components(), meshes.triangles(), meshes.meshlets(),
                   meshes.meshlet_nodes(), pairs.count, settings.rays_mode, lists.tasks(),
                   lists.rays(), lists.flood_words());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
