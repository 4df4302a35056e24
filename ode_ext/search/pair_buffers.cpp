// SPDX-License-Identifier: BSD-3-Clause
#include "search/pair_buffers.h"

#include "search/object_record.h"
#include "search/pair_order.h"

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

void PairBuffers::upload_pairs(const Scene& scene, Tile tile, bool longest_first) {
  order_.clear();
  if (longest_first && !scene.features.empty())
    put_longest_first(std::span(scene.features).subspan(tile.first, tile.count), order_);
  host_members_.clear();
  for (std::size_t i = 0; i < tile.count; ++i) {
    const auto& pair = scene.pairs[tile.first + (order_.empty() ? i : order_[i])];
    host_members_.insert(host_members_.end(), pair.begin(), pair.end());
  }
  count = static_cast<cl_uint>(tile.count);
  pairs.reserve(tile.count * sizeof(ox_pair));
  found.reserve(tile.count * sizeof(ox_found));
  ranges.reserve(tile.count * sizeof(ox_range));
  members.upload(host_members_);
}

std::span<const ox_range> PairBuffers::in_order(std::span<const ox_range> found_ranges) {
  if (order_.empty()) return found_ranges;
  in_order_.resize(found_ranges.size());
  for (std::size_t i = 0; i < found_ranges.size(); ++i) in_order_[order_[i]] = found_ranges[i];
  return in_order_;
}

}  // namespace ode_ext
