// SPDX-License-Identifier: BSD-3-Clause
#include "paper/vertex_rays.h"

#include <memory>

#include "abi/paper.h"

namespace ode_ext::paper {

VertexRays::VertexRays(Program& program, const ColliderOptions& options)
    : device_(program.device()),
      options_(options),
      kernels_(program),
      nothing_(program.device()),
      works_(program.device(), options.count_work),
      dense_first_(program.device()) {
  dense_first_.reserve(sizeof(ox_u32));
}

void VertexRays::begin_step(const Step& step) {
  if (step.memory == nullptr || options_.rays == Rays::kFull) return;
  // The blocks of temporal data have the places of the tasks of one tile.
  if (!step.workload.is_whole()) {
    step.memory->temporal.reset();
    return;
  }
  if (!step.remembers()) step.memory->temporal = std::make_unique<TemporalCache>(device_);
  step.memory->temporal->begin(step.scene);
}

void VertexRays::begin_attempt(StepData& data, const Step& step) {
  if (is_dense()) {
    place_chunks(step);
    data.lists.tasks().reserve(chunks_ * sizeof(ox_chunk_task));
  }
  if (step.remembers())
    step.memory->temporal->reserve_blocks(is_dense() ? chunks_ : data.lists.task_capacity());
  else
    nothing_.begin_without(step.workload.tile().count);
}

void VertexRays::place_chunks(const Step& step) {
  const auto& [first, count] = step.workload.tile();
  host_dense_first_.clear();
  chunks_ = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    host_dense_first_.push_back(chunks_);
    for (const std::uint32_t object : step.scene.pairs[i]) {
      const Mesh& mesh = *step.scene.meshes[step.scene.objects[object].mesh];
      chunks_ += static_cast<cl_uint>(mesh.topology->chunks.size());
    }
  }
  dense_first_.reserve(host_dense_first_.size() * sizeof(ox_u32));
  dense_first_.write(host_dense_first_.data(), host_dense_first_.size() * sizeof(ox_u32));
}

void VertexRays::run(StepData& data, Step& step) {
  kernels_.list_chunks(step.workload.launch(step.workload.tile().count), data, temporal(step),
                       is_dense(), places());
  if (is_dense()) {
    run_dense(data, step);
    return;
  }
  step.workload.settle_launches();
  if (step.remembers()) run_vertices(List::kChunksSmall, data, step);
  run_vertices(List::kChunks, data, step);
  if (step.deforms) run_vertices(List::kChunksDeformable, data, step);
  step.workload.settle_launches();
  if (step.remembers()) {
    run_rays(kernels_.rays_iterative, List::kRaysIterative, CountedKernel::kIterativeRays, data,
             step);
    step.workload.settle_launches();  // it hands rays on to the others
  }
  run_rays(kernels_.rays_full, List::kRays, CountedKernel::kBvhRays, data, step);
  if (step.deforms && options_.deformable_target == DeformableTarget::kBasic)
    run_rays(kernels_.rays_basic, List::kRaysBasic, CountedKernel::kBasicRays, data, step);
}

void VertexRays::run_dense(StepData& data, Step& step) {
  const std::uint64_t items = std::uint64_t{chunks_} * OX_CHUNK_VERTICES;
  works_.reserve(items);
  kernels_.run_monolithic(step.workload.launch(items), data, temporal(step), places(),
                          works_.buffer());
  if (works_.is_wanted())
    works_.take(items, step.report.work[static_cast<std::size_t>(CountedKernel::kMonolithic)]);
}

void VertexRays::run_vertices(List category, StepData& data, Step& step) {
  works_.reserve(OX_CHUNK_VERTICES * data.lists.capacity(category));
  kernels_.choose_vertices(category, step.workload.launch(category), data, temporal(step),
                           works_.buffer());
  if (!works_.is_wanted()) return;
  data.lists.count();
  works_.take(OX_CHUNK_VERTICES * data.lists.length(category),
              step.report.work[static_cast<std::size_t>(CountedKernel::kVertexStep)]);
}

void VertexRays::run_rays(Kernel& rays, List list, CountedKernel kernel, StepData& data,
                          Step& step) {
  works_.reserve(data.lists.capacity(list));
  kernels_.cast(rays, step.workload.launch(list), data, temporal(step), works_.buffer());
  if (!works_.is_wanted()) return;
  data.lists.count();
  works_.take(data.lists.length(list), step.report.work[static_cast<std::size_t>(kernel)]);
}

void VertexRays::warm_up(Launch wide, StepData& data, const Step& step) {
  begin_attempt(data, step);
  works_.reserve(1);
  kernels_.list_chunks(wide, data, nothing_, false, places());
  for (const List category : {List::kChunksSmall, List::kChunks, List::kChunksDeformable})
    kernels_.choose_vertices(category, wide, data, nothing_, works_.buffer());
  for (Kernel* rays : {&kernels_.rays_iterative, &kernels_.rays_full, &kernels_.rays_basic})
    kernels_.cast(*rays, wide, data, nothing_, works_.buffer());
  kernels_.run_monolithic(wide, data, nothing_, places(), works_.buffer());
}

void VertexRays::take_milliseconds(StageTimes& ms) {
  add_time(ms, Stage::kPairStep, kernels_.chunk_tasks);
  add_time(ms, Stage::kVertexStep, kernels_.vertex_rays);
  add_time(ms, Stage::kIterativeRays, kernels_.rays_iterative);
  add_time(ms, Stage::kBvhRays, kernels_.rays_full);
  add_time(ms, Stage::kBasicRays, kernels_.rays_basic);
  add_time(ms, Stage::kMonolithic, kernels_.monolithic);
}

}  // namespace ode_ext::paper
