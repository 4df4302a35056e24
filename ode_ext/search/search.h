// SPDX-License-Identifier: BSD-3-Clause
// From pairs to crossings, vertices inside and the faces these leave by: one kernel a step, in the
// order in which they run (BatchData::launch).
#pragma once

#include <cstdint>

#include "opencl/program.h"
#include "search/stage.h"

namespace ode_ext {

struct Search {
  // of_groups: of the kernels that a work-group goes through together (kernels/lib/group.h); may be
  // the same. items: that look at each pair of meshlets in cross.cl.
  Search(Program& program, Program& of_groups, std::uint32_t items)
      : pair_step(program, "pair_step"),
        cull(of_groups, "cull"),
        match(program, "match"),
        cross(program, "cross_meshlets"),
        flood(of_groups, "flood"),
        vertex_step(program, "vertex_step"),
        ray_step(program, "ray_step"),
        items_per_meshlet_pair(items) {}

  // Adds the device time since the last call.
  void take_milliseconds(StageTimes& ms) {
    add_time(ms, Stage::kPairStep, pair_step);
    add_time(ms, Stage::kCull, cull);
    add_time(ms, Stage::kMatch, match);
    add_time(ms, Stage::kCross, cross);
    add_time(ms, Stage::kFlood, flood);
    add_time(ms, Stage::kVertexStep, vertex_step);
    add_time(ms, Stage::kBvhRays, ray_step);
  }

  // A work-item for each pair; for each meshlet; for items of each pair of these; for each side of
  // a pair, of a queue; for each vertex of a chunk; for each ray.
  Kernel pair_step, cull, match, cross, flood, vertex_step, ray_step;
  const std::uint32_t items_per_meshlet_pair;
};

}  // namespace ode_ext
