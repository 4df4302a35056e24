// SPDX-License-Identifier: BSD-3-Clause
#include "search/pair_buffers.h"

#include "search/object_record.h"

namespace ode_ext {

PairBuffers::PairBuffers(Device& device)
    : objects(device, Memory::kShared),
      members(device, Memory::kShared),
      pairs(device),
      found(device),
      ranges(device, Memory::kShared) {}

void PairBuffers::upload_objects(const Scene& scene) {
  host_objects_.clear();
  for (const Scene::Object& object : scene.objects)
    host_objects_.push_back(object_record(scene, object));
  objects.upload(host_objects_);
}

void PairBuffers::upload_pairs(const Scene& scene, Tile tile) {
  host_members_.clear();
  for (std::size_t i = tile.first; i < tile.first + tile.count; ++i)
    host_members_.insert(host_members_.end(), scene.pairs[i].begin(), scene.pairs[i].end());
  count = static_cast<cl_uint>(tile.count);
  pairs.reserve(tile.count * sizeof(ox_pair));
  found.reserve(tile.count * sizeof(ox_found));
  ranges.reserve(tile.count * sizeof(ox_range));
  members.upload(host_members_);
}

}  // namespace ode_ext
