// SPDX-License-Identifier: BSD-3-Clause
// kernels/contact_step.cl and edge_contact.cl: hits and crossings -> candidates of each pair ->
// contacts.
#pragma once

#include "device/program.h"
#include "pipeline/launch.h"
#include "pipeline/step_data.h"

namespace ode_ext {

// Hands out room for candidates and crossings to the pairs, and brings the hits of each together.
class GatherStep {
 public:
  explicit GatherStep(Program& program)
      : place_(program, "contact_place"), gather_(program, "contact_gather") {}

  void run(Launch per_pair, Launch per_hit, const StepData& data) {
    const auto& [meshes, pairs, lists, settings] = data;
    place_.launch(per_pair.groups, per_pair.local, lists.counters(), pairs.hits, pairs.crossings,
                  pairs.count, pairs.segments, pairs.crossing_segments);
    gather_.launch(per_hit.groups, per_hit.local, lists.counters(), lists.lists(), lists.hits(),
                   pairs.pairs, meshes.vertices(), meshes.triangles(), pairs.segments,
                   lists.candidates());
  }
  double take_milliseconds() { return place_.take_milliseconds() + gather_.take_milliseconds(); }

 private:
  Kernel place_, gather_;
};

// Brings the crossings of each pair together, and adds the contacts that they and no vertex know.
class EdgeContactStep {
 public:
  explicit EdgeContactStep(Program& program)
      : gather_(program, "crossing_gather"), contacts_(program, "edge_contacts") {}

  void run(Launch per_pair, Launch per_crossing, const StepData& data) {
    const auto& [meshes, pairs, lists, settings] = data;
    gather_.launch(per_crossing.groups, per_crossing.local, lists.counters(), lists.lists(),
                   lists.crossings(), pairs.pairs, meshes.vertices(), meshes.edges(),
                   meshes.facets(), pairs.crossing_segments, lists.gathered_crossings(),
                   lists.crossing_order());
    contacts_.launch(per_pair.groups, per_pair.local, lists.counters(), pairs.pairs,
                     meshes.records(), meshes.chunks(), meshes.vertices(), meshes.edges(),
                     meshes.triangles(), meshes.meshlets(), meshes.meshlet_nodes(), meshes.facets(),
                     pairs.crossings, pairs.crossing_segments, pairs.count,
                     lists.gathered_crossings(), lists.crossing_order(), pairs.hits, pairs.segments,
                     lists.candidates());
  }
  double take_milliseconds() { return gather_.take_milliseconds() + contacts_.take_milliseconds(); }

 private:
  Kernel gather_, contacts_;
};

// Leaves each pair at most max_contacts of its candidates.
class ReduceStep {
 public:
  explicit ReduceStep(Program& program) : kernel_(program, "contact_reduce") {}

  void run(Launch per_pair, const StepData& data) {
    const auto& [meshes, pairs, lists, settings] = data;
    kernel_.launch(per_pair.groups, per_pair.local, lists.counters(), lists.lists(), pairs.pairs,
                   meshes.records(), pairs.hits, pairs.segments, pairs.count, lists.candidates(),
                   settings.max_contacts, settings.max_contacts_deformable, settings.rays_mode,
                   pairs.ranges, lists.contacts());
  }
  double take_milliseconds() { return kernel_.take_milliseconds(); }

 private:
  Kernel kernel_;
};

}  // namespace ode_ext
