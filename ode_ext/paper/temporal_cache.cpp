// SPDX-License-Identifier: BSD-3-Clause
#include "paper/temporal_cache.h"

#include <bit>
#include <utility>

namespace ode_ext {
namespace {

// A pair that nobody has collided for so many passes starts anew.
constexpr std::uint32_t kPassesKept = 8;

// 16 million chunks: 256 million vertices of all pairs, 256 MiB.
constexpr std::uint32_t kMostEntries = std::uint32_t{1} << 24;

constexpr std::size_t kPoseBytes = 2 * sizeof(ox_relative_pose);
constexpr std::size_t kEntryBytes = 2 * sizeof(ox_directory_entry);

std::uint32_t chunk_count(const MeshTopology& mesh) {
  return static_cast<std::uint32_t>(mesh.chunks.size());
}

// Places come in powers of two, so that those of a mesh that is rebuilt a little larger or smaller
// again and again are taken by one another: all the forgotten ones together are no more than the
// sizes, 25 at most, each in the number that was once in use at a time.
std::uint32_t place_size(std::uint32_t chunks) { return std::bit_ceil(chunks); }

}  // namespace

TemporalCache::TemporalCache(Device& device)
    : links_(device), poses_(device), directory_(device), blocks_{Buffer(device), Buffer(device)} {
  links_.reserve(sizeof(ox_link));
  poses_.extend(kPoseBytes);
  directory_.extend(kEntryBytes);
  reserve_blocks(1);
}

std::size_t TemporalCache::KeyHash::operator()(const Key& key) const {
  // Fibonacci hashing: handles differ in few, aligned bits.
  return static_cast<std::size_t>((key[0] * 0x9e3779b97f4a7c15u + key[1]) * 0x9e3779b97f4a7c15u >>
                                  16);
}

void TemporalCache::begin(const Scene& scene) {
  if (pass_ == UINT32_MAX) clear();
  ++pass_;
  host_links_.clear();
  for (const auto& pair : scene.pairs) host_links_.push_back(link(scene, pair));
  evict();
  poses_.extend(pose_count_ * kPoseBytes);
  directory_.extend(entry_count_ * kEntryBytes);
  upload();
}

void TemporalCache::begin_without(std::size_t pairs) {
  if (pairs <= unlinked_) return;
  host_links_.assign(pairs, {OX_NONE, {OX_NONE, OX_NONE}, 0});
  upload();
  unlinked_ = pairs;
}

void TemporalCache::upload() {
  unlinked_ = 0;
  links_.reserve(host_links_.size() * sizeof(ox_link));
  links_.write(host_links_.data(), host_links_.size() * sizeof(ox_link));
}

ox_link TemporalCache::link(const Scene& scene, const std::array<std::uint32_t, 2>& pair) {
  const Scene::Object& a = scene.objects[pair[0]];
  const Scene::Object& b = scene.objects[pair[1]];
  ox_link link{OX_NONE, {OX_NONE, OX_NONE}, 0};
  if (a.identity == 0 || b.identity == 0) return link;
  // The order within the pair may change from pass to pass.
  const bool swapped = b.identity < a.identity;
  const Scene::Object& low = swapped ? b : a;
  const Scene::Object& high = swapped ? a : b;
  const auto& low_mesh = scene.meshes[low.mesh]->topology;
  const auto& high_mesh = scene.meshes[high.mesh]->topology;

  const auto [found, is_new] = kept_.try_emplace(Key{low.identity, high.identity});
  Kept& kept = found->second;
  const bool same = !is_new && kept.meshes[0] == low_mesh && kept.meshes[1] == high_mesh;
  if (!same) {
    if (!is_new) release(kept);
    kept = {{}, {low_mesh, high_mesh}, 0};
    if (!place(chunk_count(*low_mesh) + chunk_count(*high_mesh), kept.place)) {
      kept_.erase(found);
      return link;
    }
  }
  link.pose = kept.place.pose;
  link.directory[swapped ? 1 : 0] = kept.place.directory;
  link.directory[swapped ? 0 : 1] = kept.place.directory + chunk_count(*low_mesh);
  link.known = same && kept.last_pass + 1 == pass_ ? 1 : 0;
  kept.last_pass = pass_;
  return link;
}

bool TemporalCache::place(std::uint32_t chunks, Place& place) {
  if (chunks > kMostEntries) return false;
  const std::uint32_t size = place_size(chunks);
  std::vector<Place>& given_up = free_[size];
  if (!given_up.empty()) {
    place = given_up.back();
    given_up.pop_back();
    return true;
  }
  if (size > kMostEntries - entry_count_) return false;
  place = {pose_count_++, entry_count_};
  entry_count_ += size;
  return true;
}

void TemporalCache::release(const Kept& kept) {
  const std::uint32_t chunks = chunk_count(*kept.meshes[0]) + chunk_count(*kept.meshes[1]);
  free_[place_size(chunks)].push_back(kept.place);
}

void TemporalCache::evict() {
  for (auto it = kept_.begin(); it != kept_.end();) {
    if (it->second.last_pass + kPassesKept >= pass_) {
      ++it;
      continue;
    }
    release(it->second);
    it = kept_.erase(it);
  }
}

void TemporalCache::reserve_blocks(std::uint64_t tasks) {
  blocks_[pass_ & 1].reserve(tasks * OX_CHUNK_VERTICES * sizeof(ox_temporal));
  blocks_[1 - (pass_ & 1)].reserve(sizeof(ox_temporal));
}

std::size_t TemporalCache::bytes() const {
  return links_.capacity() + poses_.capacity() + directory_.capacity() + blocks_[0].capacity() +
         blocks_[1].capacity();
}

void TemporalCache::clear() {
  kept_.clear();
  free_.clear();
  pose_count_ = entry_count_ = 0;
  pass_ = 1;
  // What carries a number must not be taken for what a new pass of that number wrote.
  poses_.fill_zero(poses_.capacity());
  directory_.fill_zero(directory_.capacity());
}

}  // namespace ode_ext
