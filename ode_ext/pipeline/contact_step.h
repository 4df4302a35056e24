// SPDX-License-Identifier: BSD-3-Clause
// kernels/contact_step.cl: hits -> contacts, reduced per pair. Three kernels: hand out room to the
// pairs, gather the hits of each pair, reduce.
#pragma once

#include "device/program.h"
#include "pipeline/append_buffer.h"
#include "pipeline/device_meshes.h"
#include "pipeline/launch.h"

namespace ode_ext {

class ContactStep {
 public:
  explicit ContactStep(Program& program)
      : place_(program, "contact_place"),
        gather_(program, "contact_gather"),
        reduce_(program, "contact_reduce") {}

  void run(Launch per_pair, Launch per_hit, const Buffer& counters, const AppendBuffer& hits,
           const Buffer& pairs, const DeviceMeshes& meshes, const Buffer& pair_hits,
           const Buffer& pair_segments, cl_uint pair_count, const Buffer& candidates,
           cl_uint max_contacts, const Buffer& pair_ranges, const AppendBuffer& contacts) {
    place_.launch(per_pair.groups, per_pair.local, counters, pair_hits, pair_count, pair_segments);
    gather_.launch(per_hit.groups, per_hit.local, counters, hits.records(), hits.capacity(), pairs,
                   meshes.vertices(), meshes.triangles(), pair_segments, candidates);
    reduce_.launch(per_pair.groups, per_pair.local, counters, pairs, meshes.records(), pair_hits,
                   pair_segments, pair_count, candidates, hits.capacity(), max_contacts,
                   pair_ranges, contacts.records(), contacts.capacity());
  }
  double take_milliseconds() {
    return place_.take_milliseconds() + gather_.take_milliseconds() + reduce_.take_milliseconds();
  }

 private:
  Kernel place_, gather_, reduce_;
};

}  // namespace ode_ext
