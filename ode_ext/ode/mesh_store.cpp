// SPDX-License-Identifier: BSD-3-Clause
#include "ode/mesh_store.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "mesh/deform.h"
#include "mesh/range.h"
#include "ode/mesh_import.h"
#include "ode/messages.h"

namespace ode_ext {
namespace {

// A mesh that nothing has come near for 100 seconds at 60 Hz, 6 at 1 kHz, is worth rebuilding when
// it comes back: that takes a second for a million triangles.
constexpr std::uint64_t kRoundsKept = 6000;
// Of all meshes, which may be thousands that no pass meets.
constexpr std::uint64_t kRoundsBetweenLooks = 64;

}  // namespace

const std::shared_ptr<const Mesh>& MeshStore::refresh(dTriMeshDataID data, int triangle_count,
                                                      std::uint64_t look, std::uint64_t round) {
  const auto [place, is_new] = entries_.try_emplace(data);
  Entry& entry = place->second;
  if (is_new) entry.order = next_order_++;
  const std::optional<MeshArrays> arrays = arrays_of(data);
  const bool looked = entry.last_look == look && entry.arrays == arrays;
  entry.last_round = round;
  if (has_triangles(entry, triangle_count) && !entry.changed && (looked || trust_)) {
    entry.last_look = look;
    return entry.mesh;
  }

  const MeshReader reader(data);
  if (entry.mesh == nullptr || !reader.still_gives(entry.mesh->source)) {
    reader.read(source_);
    resident_is_stale_ = true;  // whatever of this is done when memory runs out
    update(entry);
  }
  entry.arrays = arrays;
  entry.left_box = !entry.mesh->vertices.empty() && !reader.knows(box_as_given(*entry.mesh));
  entry.last_look =
      look;  // not before: where memory is short the mesh is not what it was taken for
  entry.changed = false;
  return entry.mesh;
}

void MeshStore::update(Entry& entry) {
  const std::string reason = why_refused(source_);  // before anything is another than it was
  if (!entry.deformable) {
    entry.mesh = build();
  } else {
    if (entry.mesh != nullptr) ++deformed_;
    std::shared_ptr<const Mesh> shape;
    if (entry.topology != nullptr)
      shape = deformed(entry.topology, source_, options_.open_thickness);
    if (shape == nullptr) {
      shape = std::make_shared<const Mesh>(build_mesh(
          std::move(source_), {.open_thickness = options_.open_thickness, .deformable = true}));
      entry.topology = shape->topology;
    }
    entry.mesh = std::move(shape);
  }
  const bool was_refused = std::exchange(entry.refused, !reason.empty());
  if (entry.refused && !was_refused)  // once for a mesh that goes on changing
    log(LogLevel::kWarning, "a mesh of " + std::to_string(entry.mesh->source.size() / 3) +
                                " triangles " + reason + "; its pairs get no contacts");
}

std::shared_ptr<const Mesh> MeshStore::build() {
  const std::uint64_t hash = hash_soup(source_);
  const auto [first, last] = by_content_.equal_range(hash);
  for (auto known = first; known != last; ++known) {
    auto mesh = known->second.lock();
    if (mesh != nullptr && compare_soups(mesh->source, source_) == 0) return mesh;
  }
  auto mesh = std::make_shared<const Mesh>(build_mesh(std::move(source_), options_));
  by_content_.emplace(hash, mesh);
  return mesh;
}

std::shared_ptr<const Mesh> MeshStore::known(dTriMeshDataID data, int triangle_count) const {
  const auto found = entries_.find(data);
  if (found == entries_.end() || found->second.changed) return nullptr;
  return has_triangles(found->second, triangle_count) ? found->second.mesh : nullptr;
}

bool MeshStore::has_triangles(const Entry& entry, int count) {
  return entry.mesh != nullptr && entry.mesh->source.size() == 3 * static_cast<std::size_t>(count);
}

std::shared_ptr<const Mesh> MeshStore::keep(dTriMeshDataID data, std::uint64_t round) {
  const auto found = entries_.find(data);
  if (found == entries_.end()) return nullptr;
  found->second.last_round = round;
  return found->second.mesh;
}

bool MeshStore::is_as_known(dTriMeshDataID data, const std::shared_ptr<const Mesh>& mesh) const {
  const auto found = entries_.find(data);
  return mesh != nullptr && found != entries_.end() && !found->second.changed &&
         found->second.mesh == mesh;
}

void MeshStore::announce_change(dTriMeshDataID data) {
  const auto found = entries_.find(data);
  if (found != entries_.end()) found->second.changed = true;
}

void MeshStore::set_deformable(dTriMeshDataID data, bool deformable) {
  const auto [place, is_new] = entries_.try_emplace(data);
  Entry& entry = place->second;
  if (is_new) entry.order = next_order_++;
  if (entry.deformable == deformable) return;
  entry.deformable = deformable;
  drop(entry);
  resident_is_stale_ = true;
}

void MeshStore::drop(Entry& entry) {
  entry.mesh = nullptr;
  entry.topology = nullptr;
}

void MeshStore::forget(dTriMeshDataID data) {
  if (entries_.erase(data) != 0) resident_is_stale_ = true;
}

bool MeshStore::make_room(const std::unordered_set<const Mesh*>& used, std::uint64_t round) {
  const auto drop_where = [&](const auto& is_spare) {
    bool any = false;
    for (auto& [data, entry] : entries_) {
      if (entry.mesh == nullptr || used.contains(entry.mesh.get()) || !is_spare(entry)) continue;
      drop(entry);  // and the entry stays: that it deforms, or is refused
      any = true;
    }
    return any;
  };
  const bool any = drop_where([&](const Entry& entry) { return entry.last_round < round; }) ||
                   drop_where([](const Entry&) { return true; });
  if (any) resident_is_stale_ = true;
  return any;
}

void MeshStore::prune(std::uint64_t round) {
  if (round < pruned_round_ + kRoundsBetweenLooks) return;
  pruned_round_ = round;
  if (round > kRoundsKept) forget_before(round - kRoundsKept);
}

void MeshStore::forget_before(std::uint64_t round) {
  for (auto item = entries_.begin(); item != entries_.end();) {
    Entry& entry = item->second;
    const auto next = std::next(item);
    if (entry.last_round < round) {
      if (entry.mesh != nullptr) resident_is_stale_ = true;
      drop(entry);
      if (!entry.deformable) entries_.erase(item);  // else it is to be known as such again
    }
    item = next;
  }
}

const std::vector<std::shared_ptr<const Mesh>>& MeshStore::resident() {
  if (!resident_is_stale_) return resident_;
  std::vector<const Entry*> ordered;
  for (const auto& [data, entry] : entries_)
    if (entry.mesh != nullptr) ordered.push_back(&entry);
  std::sort(ordered.begin(), ordered.end(),
            [](const Entry* a, const Entry* b) { return a->order < b->order; });
  resident_.clear();
  ++resident_number_;
  index_.clear();
  for (const Entry* entry : ordered) {
    const auto place = static_cast<std::uint32_t>(resident_.size());
    const bool is_new = index_.emplace(entry->mesh.get(), place).second;
    if (is_new || entry->deformable) resident_.push_back(entry->mesh);
  }
  std::erase_if(by_content_, [](const auto& item) { return item.second.expired(); });
  resident_is_stale_ = false;
  return resident_;
}

}  // namespace ode_ext
