// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/vertex_rays.h"

namespace ode_ext {

VertexRays::VertexRays(Program& program, const ColliderOptions& options)
    : options_(options),
      vertex_(program),
      iterative_(program, "ray_iterative"),
      bvh_(program, "ray_bvh"),
      basic_(program, "ray_basic"),
      monolithic_(program),
      works_(program.device(), options.count_work) {}

void VertexRays::begin_run(StepData& data, const Step& step) {
  if (is_dense()) {
    data.pairs.upload_dense_first();
    data.lists.tasks().reserve(data.pairs.chunks * sizeof(ox_chunk_task));
  }
  if (step.remembers())
    step.temporal().reserve_blocks(is_dense() ? data.pairs.chunks : data.lists.task_capacity());
  else
    step.temporal().begin_without(step.workload.tile().count);
}

void VertexRays::run(StepData& data, Step& step) {
  if (is_dense()) {
    run_dense(data, step);
    return;
  }
  step.workload.settle_launches();
  if (step.remembers()) run_vertices(Arrow::kChunksSmall, data, step);
  // Where crossings tell which vertices are inside, the flood has made their rays.
  if (!(floods(options_) && step.floods_all)) run_vertices(Arrow::kChunksHigh, data, step);
  if (step.deforms) run_vertices(Arrow::kChunksDeformable, data, step);
  step.workload.settle_launches();
  if (step.remembers()) {
    run_rays(iterative_, Arrow::kRaysIterative, Worker::kIterativeRays, data, step);
    step.workload.settle_launches();  // it hands rays on to the others
  }
  run_rays(bvh_, Arrow::kRaysBvh, Worker::kBvhRays, data, step);
  if (step.deforms && options_.deformable_target == DeformableTarget::kBasic)
    run_rays(basic_, Arrow::kRaysBasic, Worker::kBasicRays, data, step);
}

void VertexRays::run_dense(StepData& data, Step& step) {
  const std::uint64_t items = std::uint64_t{data.pairs.chunks} * OX_CHUNK_VERTICES;
  works_.reserve(items);
  monolithic_.run(step.workload.launch(items), data, step.temporal(), works_.buffer());
  if (works_.is_wanted())
    works_.take(items, step.report.work[static_cast<std::size_t>(Worker::kMonolithic)]);
}

void VertexRays::run_vertices(Arrow category, StepData& data, Step& step) {
  works_.reserve(OX_CHUNK_VERTICES * data.lists.capacity(category));
  vertex_.run(category, step.workload.launch(category), data, step.temporal(), works_.buffer());
  if (!works_.is_wanted()) return;
  data.lists.count();
  works_.take(OX_CHUNK_VERTICES * data.lists.length(category),
              step.report.work[static_cast<std::size_t>(Worker::kVertexStep)]);
}

void VertexRays::run_rays(RayStep& rays, Arrow list, Worker worker, StepData& data, Step& step) {
  works_.reserve(data.lists.capacity(list));
  rays.run(step.workload.launch(list), data, step.temporal(), works_.buffer());
  if (!works_.is_wanted()) return;
  data.lists.count();
  works_.take(data.lists.length(list), step.report.work[static_cast<std::size_t>(worker)]);
}

void VertexRays::warm_up(Launch wide, const StepData& data, const TemporalCache& temporal) {
  works_.reserve(1);
  for (const Arrow category : {Arrow::kChunksSmall, Arrow::kChunksHigh, Arrow::kChunksDeformable})
    vertex_.run(category, wide, data, temporal, works_.buffer());
  for (RayStep* rays : {&iterative_, &bvh_, &basic_})
    rays->run(wide, data, temporal, works_.buffer());
  monolithic_.run(wide, data, temporal, works_.buffer());
}

void VertexRays::take_milliseconds(StageTimes& ms) {
  add_time(ms, Stage::kVertexStep, vertex_);
  add_time(ms, Stage::kIterativeRays, iterative_);
  add_time(ms, Stage::kBvhRays, bvh_);
  add_time(ms, Stage::kBasicRays, basic_);
  add_time(ms, Stage::kMonolithic, monolithic_);
}

}  // namespace ode_ext
