// SPDX-License-Identifier: BSD-3-Clause
// From pairs to crossings, vertices inside and the faces these leave by: one kernel a step, in the
// order in which they run.
#pragma once

#include <cstdint>

#include "opencl/launch.h"
#include "opencl/program.h"
#include "search/batch_data.h"
#include "search/stage.h"

namespace ode_ext {

class Search {
 public:
  // items_per_meshlet_pair: for so many work-items to each in cross.cl.
  Search(Program& program, std::uint32_t items_per_meshlet_pair);

  std::uint32_t items_per_meshlet_pair() const { return items_per_meshlet_pair_; }

  // Which pairs overlap: kernels/pair_step.cl.
  void relate(Launch per_pair, const BatchData& data);
  // Where their edges cross: cull.cl, match.cl, cross.cl.
  void cull(Launch per_pair, const BatchData& data);
  void match(Launch per_meshlet, const BatchData& data);
  void cross(Launch per_item, const BatchData& data);
  // Which vertices are inside, and where their rays leave: flood.cl, vertex_step.cl,
  // ray_step.cl.
  void flood(Launch per_side, const BatchData& data);
  void choose_vertices(Launch per_vertex, const BatchData& data);
  void cast(Launch per_ray, const BatchData& data);

  // Adds the device time since the last call.
  void take_milliseconds(StageTimes& ms);

 private:
  Kernel pair_step_, cull_, match_, cross_, flood_, vertex_step_, ray_step_;
  std::uint32_t items_per_meshlet_pair_;
};

}  // namespace ode_ext
