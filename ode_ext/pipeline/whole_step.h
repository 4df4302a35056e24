// SPDX-License-Identifier: BSD-3-Clause
// kernels/whole_step.cl: pairs -> contacts, in one launch.
#pragma once

#include "device/program.h"
#include "pipeline/step_data.h"
#include "pipeline/temporal_cache.h"

namespace ode_ext {

class WholeStep {
 public:
  explicit WholeStep(Program& program) : kernel_(program, "whole_step") {}

  // `temporal`: of a step that remembers nothing.
  void run(const StepData& data, const TemporalCache& temporal) {
    const auto& [meshes, pairs, lists, settings] = data;
    kernel_.launch(1, 1, lists.counters(), lists.lists(), pairs.objects, meshes.records(),
                   meshes.chunks(), pairs.members, temporal.links(), pairs.count, temporal.step(),
                   settings.rays_mode, settings.displacement_limit, temporal.poses(),
                   temporal.directory(), pairs.pairs, pairs.hits, pairs.crossings, pairs.heads,
                   pairs.ranges, lists.tasks(), meshes.meshlet_nodes(), lists.meshlets(),
                   meshes.meshlets(), lists.meshlet_pairs(), lists.crossings(),
                   lists.crossing_links(), meshes.vertices(), meshes.edges(), meshes.ring_starts(),
                   meshes.rings(), meshes.components(), meshes.triangles(), lists.rays(),
                   lists.flood_words(), temporal.before(), temporal.now(), settings.walk_limit,
                   lists.hits(), pairs.segments, pairs.crossing_segments, lists.candidates(),
                   meshes.facets(), lists.gathered_crossings(), lists.crossing_order(),
                   settings.max_contacts, settings.max_contacts_deformable, lists.contacts());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
