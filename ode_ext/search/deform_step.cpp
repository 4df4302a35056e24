// SPDX-License-Identifier: BSD-3-Clause
#include "search/deform_step.h"

#include <algorithm>

#include "search/device_meshes.h"

namespace ode_ext {

DeformStep::DeformStep(Program& program)
    : triangles_(program, "deform_triangles"),
      vertices_(program, "deform_vertices"),
      exits_(program, "deform_exits"),
      chunks_(program, "deform_chunks"),
      meshlets_(program, "deform_meshlets"),
      meshlet_nodes_(program, "deform_meshlet_nodes"),
      meshes_(program, "deform_meshes"),
      rest_(program, "deform_rest"),
      moves_(program.device(), Memory::kShared),
      starts_(program.device(), Memory::kShared),
      positions_(program.device(), Memory::kShared),
      measures_(program.device()),
      local_(std::min<std::size_t>(64, program.device().info().work_group_limit)) {}

void DeformStep::run(const std::vector<MeshMove>& moves, const std::vector<Vec3f>& positions,
                     const DeviceMeshes& meshes) {
  host_moves_.clear();
  host_starts_.clear();
  std::size_t triangles = 0;
  for (const MeshMove& move : moves) {
    host_moves_.push_back(move.record);
    host_moves_.back().measure_first = static_cast<ox_u32>(triangles);
    if (!move.rests) triangles += move.record.shape.triangle_count;
  }
  const Work work = plan(moves);
  moves_.upload(host_moves_);
  starts_.upload(host_starts_);
  positions_.upload(positions);
  measures_.reserve(4 * triangles * sizeof(ox_f32));
  launch(work, meshes);
}

void DeformStep::warm_up(Launch wide, const DeviceMeshes& meshes) {
  host_moves_.assign(1, ox_move{});
  host_starts_.assign(1, 0);  // no move, no item
  moves_.upload(host_moves_);
  starts_.upload(host_starts_);
  positions_.upload(std::vector<Vec3f>{});
  const Items none{0, 0};
  launch({none, none, none, none, none, none, none}, meshes, &wide);
}

double DeformStep::take_milliseconds() {
  double sum = 0;
  for (Kernel* kernel :
       {&triangles_, &vertices_, &exits_, &chunks_, &meshlets_, &meshlet_nodes_, &meshes_, &rest_})
    sum += kernel->take_milliseconds();
  return sum;
}

template <class CountOf>
DeformStep::Items DeformStep::append_starts(const std::vector<MeshMove>& moves, CountOf count_of) {
  Items items{static_cast<cl_uint>(host_starts_.size()), 0};
  for (const MeshMove& move : moves) {
    host_starts_.push_back(static_cast<ox_u32>(items.count));
    items.count += count_of(move);
  }
  host_starts_.push_back(static_cast<ox_u32>(items.count));
  return items;
}

DeformStep::Work DeformStep::plan(const std::vector<MeshMove>& moves) {
  const auto unless_resting = [](auto count_of) {
    return [=](const MeshMove& move) -> std::uint32_t { return move.rests ? 0 : count_of(move); };
  };
  Work work{};
  work.triangles = append_starts(
      moves, unless_resting([](const auto& move) { return move.record.shape.triangle_count; }));
  work.vertices = append_starts(
      moves, unless_resting([](const auto& move) { return move.record.vertex_count; }));
  work.exits = append_starts(moves, unless_resting([](const auto& move) {
                               const ox_move& record = move.record;
                               const bool closed = (record.shape.flags & OX_MESH_CLOSED) != 0;
                               return closed ? record.vertex_count : 0;
                             }));
  work.chunks = append_starts(
      moves, unless_resting([](const auto& move) { return move.record.shape.chunk_count; }));
  work.meshlets = append_starts(
      moves, unless_resting([](const auto& move) { return move.record.shape.meshlet_count; }));
  work.meshlet_nodes = append_starts(moves, unless_resting([](const auto& move) {
                                       return OX_LANES * move.record.shape.meshlet_node_count;
                                     }));
  work.rest = append_starts(
      moves, [](const MeshMove& move) { return move.rests ? move.record.vertex_count : 0; });
  return work;
}

void DeformStep::launch(const Work& work, const DeviceMeshes& meshes, const Launch* wide) {
  const auto count = static_cast<cl_uint>(wide != nullptr ? 0 : host_moves_.size());
  // A grid of 2^30 keeps every index within 32 bits; the loops in the kernels do the rest.
  const auto run = [&](Kernel& kernel, std::size_t items, const auto&... arguments) {
    const std::size_t groups =
        std::min((items + local_ - 1) / local_, (std::size_t{1} << 30) / local_);
    const Launch launch = wide != nullptr ? *wide : Launch{groups, local_};
    kernel.launch(launch.groups, launch.local, moves_, count, arguments...);
  };
  run(triangles_, work.triangles.count, starts_, work.triangles.starts_first, positions_,
      meshes.topologies(), meshes.triangles(), measures_);
  run(vertices_, work.vertices.count, starts_, work.vertices.starts_first, positions_,
      meshes.topologies(), meshes.triangles(), measures_, meshes.vertices());
  run(meshlets_, work.meshlets.count, starts_, work.meshlets.starts_first, meshes.vertices(),
      meshes.triangles(), meshes.meshlets());
  run(meshlet_nodes_, work.meshlet_nodes.count, starts_, work.meshlet_nodes.starts_first,
      meshes.meshlets(), meshes.meshlet_nodes());
  run(exits_, work.exits.count, starts_, work.exits.starts_first, meshes.topologies(),
      meshes.meshlets(), meshes.meshlet_nodes(), meshes.vertices());
  run(rest_, work.rest.count, starts_, work.rest.starts_first, meshes.vertices(), meshes.chunks());
  run(chunks_, work.chunks.count, starts_, work.chunks.starts_first, meshes.vertices(),
      meshes.chunks());
  run(meshes_, host_moves_.size(), meshes.chunks(), meshes.records());
}

}  // namespace ode_ext
