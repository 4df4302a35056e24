// SPDX-License-Identifier: BSD-3-Clause
// kernels/contact_step.cl: hits -> contacts, reduced per pair. Three kernels: hand out room to the
// pairs, gather the hits of each pair, reduce.
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
        reduce_(program, "contact_reduce") {}

  void run(Launch per_pair, Launch per_hit, const AppendLists& lists, const DeviceMeshes& meshes,
           const PairBuffers& pairs, const StepSettings& settings) {
    place_.launch(per_pair.groups, per_pair.local, lists.counters(), pairs.hits, pairs.count,
                  pairs.segments);
    gather_.launch(per_hit.groups, per_hit.local, lists.counters(), lists.lists(), lists.hits(),
                   pairs.pairs, meshes.vertices(), meshes.triangles(), pairs.segments,
                   lists.candidates());
    reduce_.launch(per_pair.groups, per_pair.local, lists.counters(), lists.lists(), pairs.pairs,
                   meshes.records(), pairs.hits, pairs.segments, pairs.count, lists.candidates(),
                   settings.max_contacts, settings.max_contacts_deformable, pairs.ranges,
                   lists.contacts());
  }
  double take_milliseconds() {
    return place_.take_milliseconds() + gather_.take_milliseconds() + reduce_.take_milliseconds();
  }

 private:
  Kernel place_, gather_, reduce_;
};

}  // namespace ode_ext
