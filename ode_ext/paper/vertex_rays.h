// SPDX-License-Identifier: BSD-3-Clause
// From pairs to hits by rays of vertices, as the paper has it (GRAPP section 3): which vertices are
// to be looked at, which of them get a ray, and of which kind, and what the rays hit; or one kernel
// does the last two. In place of the flood.
#pragma once

#include <vector>

#include "collide/batch.h"
#include "collide/options.h"
#include "opencl/program.h"
#include "paper/kernels.h"
#include "paper/temporal_cache.h"
#include "paper/work_count.h"
#include "search/batch_data.h"

namespace ode_ext::paper {

class VertexRays {
 public:
  VertexRays(Program& program, const ColliderOptions& options);

  // Before the first attempt at a batch: finds its temporal data, where it is to have some.
  void begin_batch(const Batch& batch);
  // Before an attempt: what it needs beside lists and pairs.
  void begin_attempt(BatchData& data, const Batch& batch);
  void run(BatchData& data, Batch& batch);
  // The device lost what was uploaded.
  void forget() { nothing_.forget_links(); }
  void warm_up(Launch wide, BatchData& data, const Batch& batch);
  // Adds the device time since the last call.
  void take_milliseconds(StageTimes& ms);

 private:
  // Whether each chunk has a place of its own, not in lists.
  bool is_dense() const { return options_.organization == Organization::kMonolithic; }
  TemporalCache& temporal(const Batch& batch) {
    return batch.remembers() ? *batch.memory->temporal : nothing_;
  }
  DensePlaces places() const { return {dense_first_, chunks_}; }
  void place_chunks(const Batch& batch);
  void run_dense(BatchData& data, Batch& batch);
  void run_vertices(List category, BatchData& data, Batch& batch);
  void run_rays(Kernel& rays, List list, CountedKernel kernel, BatchData& data, Batch& batch);

  Device& device_;
  const ColliderOptions& options_;
  Kernels kernels_;
  TemporalCache nothing_;  // of batches that remember nothing
  WorkRecords works_;
  Buffer dense_first_;
  std::vector<ox_u32> host_dense_first_;
  cl_uint chunks_ = 0;  // of all pairs
};

}  // namespace ode_ext::paper
