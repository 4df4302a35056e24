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

void VertexRays::begin_batch(const Batch& batch) {
  if (batch.memory == nullptr || options_.rays == Rays::kFull) return;
  // The blocks of temporal data have the places of the tasks of one tile.
  if (!batch.workload.is_whole()) {
    batch.memory->temporal.reset();
    return;
  }
  if (!batch.remembers()) batch.memory->temporal = std::make_unique<TemporalCache>(device_);
  batch.memory->temporal->begin(batch.scene);
}

void VertexRays::begin_attempt(BatchData& data, const Batch& batch) {
  if (is_dense()) {
    place_chunks(batch);
    data.lists.tasks().reserve(chunks_ * sizeof(ox_chunk_task));
  }
  if (batch.remembers())
    batch.memory->temporal->reserve_blocks(is_dense() ? chunks_ : data.lists.task_capacity());
  else
    nothing_.begin_without(batch.workload.tile().count);
}

void VertexRays::place_chunks(const Batch& batch) {
  const auto& [first, count] = batch.workload.tile();
  host_dense_first_.clear();
  chunks_ = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    host_dense_first_.push_back(chunks_);
    for (const std::uint32_t object : batch.scene.pairs[i]) {
      const Mesh& mesh = *batch.scene.meshes[batch.scene.objects[object].mesh];
      chunks_ += static_cast<cl_uint>(mesh.topology->chunks.size());
    }
  }
  dense_first_.reserve(host_dense_first_.size() * sizeof(ox_u32));
  dense_first_.write(host_dense_first_.data(), host_dense_first_.size() * sizeof(ox_u32));
}

void VertexRays::run(BatchData& data, Batch& batch) {
  kernels_.list_chunks(batch.workload.launch(batch.workload.tile().count), data, temporal(batch),
                       is_dense(), places());
  if (is_dense()) {
    run_dense(data, batch);
    return;
  }
  batch.workload.settle_launches();
  if (batch.remembers()) run_vertices(List::kChunksSmall, data, batch);
  run_vertices(List::kChunks, data, batch);
  if (batch.deforms) run_vertices(List::kChunksDeformable, data, batch);
  batch.workload.settle_launches();
  if (batch.remembers()) {
    run_rays(kernels_.rays_iterative, List::kRaysIterative, CountedKernel::kIterativeRays, data,
             batch);
    batch.workload.settle_launches();  // it hands rays on to the others
  }
  run_rays(kernels_.rays_full, List::kRays, CountedKernel::kBvhRays, data, batch);
  if (batch.deforms && options_.deformable_target == DeformableTarget::kBasic)
    run_rays(kernels_.rays_basic, List::kRaysBasic, CountedKernel::kBasicRays, data, batch);
}

void VertexRays::run_dense(BatchData& data, Batch& batch) {
  const std::uint64_t items = std::uint64_t{chunks_} * OX_CHUNK_VERTICES;
  works_.reserve(items);
  kernels_.run_monolithic(batch.workload.launch(items), data, temporal(batch), places(),
                          works_.buffer());
  if (works_.is_wanted())
    works_.take(items, batch.report.work[static_cast<std::size_t>(CountedKernel::kMonolithic)]);
}

void VertexRays::run_vertices(List category, BatchData& data, Batch& batch) {
  works_.reserve(OX_CHUNK_VERTICES * data.lists.capacity(category));
  kernels_.choose_vertices(category, batch.workload.launch(category), data, temporal(batch),
                           works_.buffer());
  if (!works_.is_wanted()) return;
  data.lists.count();
  works_.take(OX_CHUNK_VERTICES * data.lists.length(category),
              batch.report.work[static_cast<std::size_t>(CountedKernel::kVertexStep)]);
}

void VertexRays::run_rays(Kernel& rays, List list, CountedKernel kernel, BatchData& data,
                          Batch& batch) {
  works_.reserve(data.lists.capacity(list));
  kernels_.cast(rays, batch.workload.launch(list), data, temporal(batch), works_.buffer());
  if (!works_.is_wanted()) return;
  data.lists.count();
  works_.take(data.lists.length(list), batch.report.work[static_cast<std::size_t>(kernel)]);
}

void VertexRays::warm_up(Launch wide, BatchData& data, const Batch& batch) {
  begin_attempt(data, batch);
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
