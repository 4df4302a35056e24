// SPDX-License-Identifier: BSD-3-Clause
// kernels/contact_step.cl and edge_contact.cl: hits and crossings -> contacts, reduced per pair.
// Kernels: hand out room to the pairs, gather the hits and the crossings of each pair, find the
// contacts of edges, reduce.
#pragma once

#include "device/program.h"
#include "pipeline/append_lists.h"
#include "pipeline/device_meshes.h"
#include "pipeline/launch.h"
#include "pipeline/pair_buffers.h"
#include "pipeline/step_settings.h"

namespace ode_ext {

class ContactStep {
 public:
  explicit ContactStep(Program& program)
      : place_(program, "contact_place"),
        gather_(program, "contact_gather"),
        gather_crossings_(program, "crossing_gather"),
        edges_(program, "edge_contacts"),
        reduce_(program, "contact_reduce") {}

  void run(Launch per_pair, Launch per_hit, Launch per_crossing, const AppendLists& lists,
           const DeviceMeshes& meshes, const PairBuffers& pairs, const StepSettings& settings) {
    place_.launch(per_pair.groups, per_pair.local, lists.counters(), pairs.hits, pairs.crossings,
                  pairs.count, pairs.segments, pairs.crossing_segments);
    gather_.launch(per_hit.groups, per_hit.local, lists.counters(), lists.lists(), lists.hits(),
                   pairs.pairs, meshes.vertices(), meshes.triangles(), pairs.segments,
                   lists.candidates());
    if ((settings.rays_mode & OX_RAYS_EDGES) != 0) {
      gather_crossings_.launch(per_crossing.groups, per_crossing.local, lists.counters(),
                               lists.lists(), lists.crossings(), pairs.pairs, meshes.vertices(),
                               meshes.edges(), meshes.facets(), pairs.crossing_segments,
                               lists.gathered_crossings(), lists.crossing_order());
      edges_.launch(per_pair.groups, per_pair.local, pairs.pairs, meshes.records(), meshes.chunks(),
                    meshes.vertices(), meshes.edges(), meshes.nodes(), meshes.triangles(),
                    meshes.facets(), pairs.crossings, pairs.crossing_segments, pairs.count,
                    lists.gathered_crossings(), lists.crossing_order(), pairs.hits, pairs.segments,
                    lists.candidates());
    }
    reduce_.launch(per_pair.groups, per_pair.local, lists.counters(), lists.lists(), pairs.pairs,
                   meshes.records(), pairs.hits, pairs.segments, pairs.count, lists.candidates(),
                   settings.max_contacts, settings.max_contacts_deformable, settings.rays_mode,
                   pairs.ranges, lists.contacts());
  }
  double take_milliseconds() {
    return place_.take_milliseconds() + gather_.take_milliseconds() + reduce_.take_milliseconds();
  }
  double take_edge_milliseconds() {
    return gather_crossings_.take_milliseconds() + edges_.take_milliseconds();
  }

 private:
  Kernel place_, gather_, gather_crossings_, edges_, reduce_;
};

}  // namespace ode_ext
