// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/pair_buffers.h"

#include <algorithm>

#include "pipeline/object_record.h"

namespace ode_ext {

PairBuffers::PairBuffers(Device& device)
    : objects(device),
      members(device),
      dense_first(device),
      pairs(device),
      hits(device),
      crossings(device),
      heads(device),
      ranges(device),
      segments(device),
      crossing_segments(device) {}

void PairBuffers::upload_objects(const Scene& scene) {
  host_objects_.clear();
  for (const Scene::Object& object : scene.objects) host_objects_.push_back(object_record(object));
  objects.reserve(std::max<std::size_t>(1, host_objects_.size()) * sizeof(ox_object));
  objects.write(host_objects_.data(), host_objects_.size() * sizeof(ox_object));
}

void PairBuffers::upload_pairs(const Scene& scene, Tile tile) {
  host_members_.clear();
  host_dense_first_.clear();
  chunks = 0;
  for (std::size_t i = tile.first; i < tile.first + tile.count; ++i) {
    host_dense_first_.push_back(chunks);
    for (const std::uint32_t object : scene.pairs[i]) {
      host_members_.push_back(object);
      const Mesh& mesh = topology(*scene.meshes[scene.objects[object].mesh]);
      chunks += static_cast<cl_uint>(mesh.chunks.size());
    }
  }
  count = static_cast<cl_uint>(tile.count);
  members.reserve(2 * tile.count * sizeof(ox_u32));
  dense_first.reserve(tile.count * sizeof(ox_u32));
  pairs.reserve(tile.count * sizeof(ox_pair));
  hits.reserve(tile.count * sizeof(ox_u32));
  crossings.reserve(tile.count * sizeof(ox_u32));
  heads.reserve(2 * tile.count * sizeof(ox_u32));
  ranges.reserve(tile.count * sizeof(ox_range));
  segments.reserve(tile.count * sizeof(ox_u32));
  crossing_segments.reserve(tile.count * sizeof(ox_u32));
  members.write(host_members_.data(), host_members_.size() * sizeof(ox_u32));
}

void PairBuffers::upload_dense_first() {
  dense_first.write(host_dense_first_.data(), host_dense_first_.size() * sizeof(ox_u32));
}

}  // namespace ode_ext
