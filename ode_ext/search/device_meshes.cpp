// SPDX-License-Identifier: BSD-3-Clause
#include "search/device_meshes.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace ode_ext {
namespace {

// A power of two, so that scaling rounds nothing.
float scale_for(float extent) {
  if (extent == 0) return 1;
  return std::ldexp(1.0f, std::clamp(-std::ilogb(extent), -126, 126));
}

}  // namespace

DeviceMeshes::DeviceMeshes(Program& program)
    : device_(program.device()),
      deform_(program),
      mesh_records_(device_),
      parts_(device_),
      topologies_(device_) {}

void DeviceMeshes::set(const MeshList& meshes) {
  // Nothing is in flight here (a batch ends with a wait), so the arrays may be rebuilt in place.
  const bool anew = !are_shapes_of_the_same(meshes);
  if (anew)
    rebuild(meshes);
  else
    std::vector<ox_u32>().swap(host_topologies_);  // uploaded
  moves_.clear();
  positions_.clear();
  for (auto& [i, deformable] : deformables_) {
    const bool changed = anew || meshes[i] != meshes_[i];
    if (changed || deformable.moving) add_move(i, *meshes[i], !changed);
    if (!anew) deformable.moving = changed;
  }
  if (!moves_.empty()) deform_.run(moves_, positions_, *this);
  meshes_ = meshes;
}

void DeviceMeshes::forget() {
  meshes_.clear();
  deformables_.clear();
}

bool DeviceMeshes::are_shapes_of_the_same(const MeshList& meshes) const {
  return std::equal(meshes.begin(), meshes.end(), meshes_.begin(), meshes_.end(),
                    [](const auto& a, const auto& b) { return a->topology == b->topology; });
}

void DeviceMeshes::rebuild(const MeshList& meshes) {
  std::unordered_map<const MeshTopology*, const Mesh*> shapes_before;
  for (const auto& mesh : meshes_) shapes_before.emplace(mesh->topology.get(), mesh.get());
  const MeshList before = std::exchange(meshes_, {});  // keeps them until they are appended
  ranges_.clear();
  owner_triangles_.clear();
  host_records_.clear();
  host_topologies_.clear();
  deformables_.clear();
  MeshRecords parts(parts_, meshes);
  if (!device_.is_idle()) device_.finish();
  for (const auto& mesh : meshes) {
    const auto known = shapes_before.find(mesh->topology.get());
    append(parts, *mesh, known == shapes_before.end() ? nullptr : known->second);
  }
  parts.close();
  mesh_records_.upload(host_records_);
  topologies_.upload(host_topologies_);
}

// `before`: the shape it had until now, if it was here.
void DeviceMeshes::append(MeshRecords& parts, const Mesh& mesh, const Mesh* before) {
  ranges_.push_back(parts.next());
  if (mesh.deformable) {
    Deformable& deformable = deformables_[static_cast<std::uint32_t>(host_records_.size())];
    deformable.topology = append_topology(*mesh.topology, host_topologies_);
    deformable.moving = before != nullptr && before != &mesh;
  }
  host_records_.push_back(
      parts.append(mesh, mesh.deformable && before != nullptr ? *before : mesh));
  append_owners(*mesh.topology);
}

void DeviceMeshes::append_owners(const MeshTopology& mesh) {
  const std::size_t first = owner_triangles_.size();
  owner_triangles_.resize(first + mesh.vertex_count, UINT32_MAX);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t corner : mesh.triangles[t]) {
      std::uint32_t& owner = owner_triangles_[first + corner];
      owner = std::min(owner, mesh.source_triangle[t]);
    }
}

void DeviceMeshes::add_move(std::uint32_t mesh, const Mesh& shape, bool rests) {
  const Deformable& deformable = deformables_.at(mesh);
  MeshMove move;
  // Not host_records_[mesh] itself: what was uploaded just now may still be read from there.
  move.record.shape = host_records_[mesh];
  measure(shape, move.record.shape);
  move.record.mesh = mesh;
  move.record.vertex_first = ranges_[mesh].vertex_first;
  move.record.vertex_count = static_cast<ox_u32>(shape.vertices.size());
  move.record.position_first = static_cast<ox_u32>(positions_.size());
  move.record.corner_first = deformable.topology.corner_first;
  move.record.incident_first = deformable.topology.incident_first;
  move.record.scale = scale_for(move.record.shape.extent);
  move.record.thickness = thickness_of(shape);
  // A vertex may lie on a face that is not its own (mesh/exit_distance.cpp); rounding, here of
  // the ray test too, sees them less than 16 roundings of the size apart (ray_step.cl).
  move.record.on_surface = 0x1p-20f * 2 * shape.radius;
  move.rests = rests;
  moves_.push_back(move);
  if (!rests) positions_.insert(positions_.end(), shape.vertices.begin(), shape.vertices.end());
}

}  // namespace ode_ext
