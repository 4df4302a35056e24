// SPDX-License-Identifier: BSD-3-Clause
// From pairs to hits by rays of vertices, as the paper has it (GRAPP section 3): the vertex step
// says which vertices get a ray, and of which kind, the ray step casts them; or one kernel does
// both.
#pragma once

#include "device/program.h"
#include "pipeline/monolithic_step.h"
#include "pipeline/options.h"
#include "pipeline/ray_step.h"
#include "pipeline/step.h"
#include "pipeline/step_data.h"
#include "pipeline/vertex_step.h"
#include "pipeline/work_count.h"

namespace ode_ext {

class VertexRays {
 public:
  VertexRays(Program& program, const ColliderOptions& options);

  // Whether a pair's tasks have places of their own, not in lists (PairStep's `dense`).
  bool is_dense() const { return options_.organisation == Organisation::kMonolithic; }
  // Before a run: what it needs beside lists and pairs.
  void begin_run(StepData& data, const Step& step);
  void run(StepData& data, Step& step);
  void warm_up(Launch wide, const StepData& data, const TemporalCache& temporal);
  // Adds the device time since the last call.
  void take_milliseconds(StageTimes& ms);

 private:
  void run_dense(StepData& data, Step& step);
  void run_vertices(Arrow category, StepData& data, Step& step);
  void run_rays(RayStep& rays, Arrow list, Worker worker, StepData& data, Step& step);

  const ColliderOptions& options_;
  VertexStep vertex_;
  RayStep iterative_, bvh_, basic_;
  MonolithicStep monolithic_;
  WorkRecords works_;
};

}  // namespace ode_ext
