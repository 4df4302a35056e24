// SPDX-License-Identifier: BSD-3-Clause
// The kernels of the pipeline, step by step, in the order in which they run.
#pragma once

#include <optional>

#include "device/program.h"
#include "pipeline/launch.h"
#include "pipeline/stage.h"
#include "pipeline/step_data.h"

namespace ode_ext {

class Steps {
 public:
  // has_whole: the program was built for a whole step too. assembles: what becomes of hits and
  // crossings is its own affair, and not that of separating planes (plane_assembly.h).
  Steps(Program& program, bool has_whole, bool assembles = true);

  // Which pairs overlap: kernels/pair_step.cl.
  void relate(Launch per_pair, const StepData& data);
  // Where their edges cross: cull.cl, match.cl, cross.cl.
  void cull(Launch per_pair, const StepData& data);
  void match(Launch per_meshlet, const StepData& data);
  void cross(Launch per_meshlet_pair, const StepData& data);
  // Which vertices are inside, and where their rays leave: flood.cl, vertex_step.cl, ray_step.cl.
  void flood(Launch per_side, const StepData& data);
  void choose_vertices(Launch per_vertex, const StepData& data);
  void cast(Launch per_ray, const StepData& data);
  // What becomes of hits and crossings: contact_step.cl and edge_contact.cl.
  void gather(Launch per_pair, Launch per_hit, const StepData& data);
  void add_edge_contacts(Launch per_pair, Launch per_crossing, const StepData& data);
  void reduce(Launch per_pair, const StepData& data);

  // All of them in one launch: whole_step.cl. Only if has_whole.
  void run_whole(Launch shares, const StepData& data);

  // Adds the device time since the last call.
  void take_milliseconds(StageTimes& ms);

 private:
  struct Assembly {
    explicit Assembly(Program& program);
    Kernel place, gather, gather_crossings, edge_contacts, reduce;
  };

  Kernel pair_step_, cull_, match_, cross_, flood_, vertex_step_, ray_step_;
  std::optional<Assembly> assembly_;
  std::optional<Kernel> whole_;
};

}  // namespace ode_ext
