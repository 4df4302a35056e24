// SPDX-License-Identifier: BSD-3-Clause
#include "search/device_meshes.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "opencl/error.h"
#include "search/deform_topology.h"

namespace ode_ext {
namespace {

// Kernels put two bits more beside the index of an edge (lib/flood_table.h, OX_OF_SHIFT).
constexpr std::size_t kMostEdges = std::size_t{1} << 30;

// A power of two, so that scaling rounds nothing.
float scale_for(float extent) {
  if (extent == 0) return 1;
  return std::ldexp(1.0f, std::clamp(-std::ilogb(extent), -126, 126));
}

}  // namespace

DeviceMeshes::DeviceMeshes(Program& program)
    : device_(program.device()), deform_(program), mesh_records_(device_), parts_(device_) {}

void DeviceMeshes::set(const MeshList& meshes) {
  // Nothing is in flight here (a batch ends with a wait), so records may be written in place.
  if (!are_placed(meshes)) place(meshes);
  moves_.clear();
  positions_.clear();
  for (std::uint32_t i = 0; i < meshes.size(); ++i) {
    const Placed& placed = placed_[i];
    const bool changed = placed.is_new || meshes[i] != placed.mesh;
    if (meshes[i]->deformable && (changed || placed.moving)) add_move(i, *meshes[i], !changed);
  }
  if (!moves_.empty()) deform_.run(moves_, positions_, *this);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    Placed& placed = placed_[i];
    const bool changed = meshes[i] != placed.mesh;
    if (!placed.is_new) placed.moving = changed;
    placed.is_new = false;
    if (changed) placed.mesh = meshes[i];
  }
}

void DeviceMeshes::forget() {
  placed_.clear();
  parts_.release();
}

bool DeviceMeshes::are_placed(const MeshList& meshes) const {
  return std::equal(meshes.begin(), meshes.end(), placed_.begin(), placed_.end(),
                    [](const auto& mesh, const Placed& placed) {
                      return mesh->topology == placed.mesh->topology;
                    });
}

void DeviceMeshes::place(const MeshList& meshes) {
  std::vector<Placed> before = std::exchange(placed_, {});  // where this fails there are none
  std::unordered_multimap<const MeshTopology*, Placed*> known;
  for (Placed& placed : before) known.emplace(placed.mesh->topology.get(), &placed);
  std::vector<Placed> places(meshes.size());
  MeshCounts in_use, more;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const auto found = known.find(meshes[i]->topology.get());
    if (found == known.end()) {
      places[i].mesh = meshes[i];
      more.add(*meshes[i]);
    } else {
      places[i] = std::move(*found->second);
      known.erase(found);
      in_use.add(*meshes[i]);
    }
  }
  const std::size_t out_of_use = end_.triangles - in_use.triangles;
  const bool has_room = in_use.triangles != 0 && out_of_use <= in_use.triangles + more.triangles &&
                        end_.edges + more.edges <= kMostEdges;
  if (!has_room || !try_to_append(more, places)) place_anew(meshes, places);
  host_records_.clear();
  for (const Placed& placed : places) host_records_.push_back(placed.record);
  mesh_records_.upload(host_records_);
  placed_ = std::move(places);
}

// False: what is there and what it grows to had no room at once, or some other call failed.
bool DeviceMeshes::try_to_append(const MeshCounts& more, std::vector<Placed>& places) {
  try {
    append(more, places);
    return true;
  } catch (const DeviceError&) {
    return false;
  }
}

void DeviceMeshes::place_anew(const MeshList& meshes, std::vector<Placed>& places) {
  MeshCounts all;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    all.add(*meshes[i]);
    places[i].is_new = true;
    places[i].moving = places[i].mesh != meshes[i];
  }
  if (all.edges > kMostEdges)
    throw DeviceError(CL_INVALID_BUFFER_SIZE,
                      "Meshes have more than 2^30 edges together. Make the scene smaller.");
  end_ = {};
  parts_.release();  // of what grew already none is needed
  append(all, places);
}

// The meshes that are new, with their vertices where they were until now.
void DeviceMeshes::append(const MeshCounts& more, std::vector<Placed>& places) {
  MeshRecords parts(parts_, end_, more);
  if (!device_.is_idle()) device_.finish();
  owner_triangles_.resize(end_.vertices);
  for (Placed& placed : places) {
    if (!placed.is_new) continue;
    placed.range = parts.next();
    placed.record = parts.append(*placed.mesh);
    append_owners(*placed.mesh->topology);
  }
  end_ = parts.close();
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
  Placed& placed = placed_[mesh];
  measure(shape, placed.record);
  MeshMove move;
  move.record.shape = placed.record;
  move.record.mesh = mesh;
  move.record.vertex_first = placed.range.vertex_first;
  move.record.vertex_count = static_cast<ox_u32>(shape.vertices.size());
  move.record.position_first = static_cast<ox_u32>(positions_.size());
  move.record.corner_first = placed.range.topology_first;
  move.record.incident_first =
      placed.range.topology_first + static_cast<ox_u32>(incident_words(*shape.topology));
  move.record.scale = scale_for(move.record.shape.extent);
  move.record.thickness = thickness_of(shape);
  // A vertex may lie on a face that is not its own (mesh/exit_distance.cpp); rounding, of its
  // coordinates and of the ray test, sees them less than 16 roundings of these apart
  // (ray_step.cl): they are as large as the mesh, or as it is far from its origin.
  move.record.on_surface = 0x1p-20f * std::max(2 * shape.radius, move.record.shape.extent);
  move.rests = rests;
  moves_.push_back(move);
  if (!rests) positions_.insert(positions_.end(), shape.vertices.begin(), shape.vertices.end());
}

}  // namespace ode_ext
