// SPDX-License-Identifier: BSD-3-Clause
#include "ode/mesh_store.h"

#include <algorithm>
#include <string>

#include "ode/mesh_import.h"
#include "ode/messages.h"

namespace ode_ext {
namespace {

// A mesh that nothing has come near for ten seconds at 60 Hz is worth rebuilding when it comes
// back.
constexpr std::uint64_t kPassesKept = 600;

}  // namespace

const std::shared_ptr<const Mesh>& MeshStore::refresh(dTriMeshDataID data, std::uint64_t look,
                                                      std::uint64_t pass) {
  const auto [place, is_new] = entries_.try_emplace(data);
  Entry& entry = place->second;
  if (is_new) entry.order = next_order_++;
  const bool looked = entry.last_look == look;
  entry.last_look = look;
  entry.last_pass = pass;
  if (entry.mesh != nullptr && !entry.changed && (looked || trust_)) return entry.mesh;

  read_triangles(data, soup_);
  const std::uint64_t hash = hash_soup(soup_.data(), soup_.size());
  if (entry.mesh == nullptr || entry.hash != hash ||
      static_cast<std::size_t>(entry.triangle_count) != soup_.size() / 3) {
    entry.mesh = build(hash, entry.deformable);
    entry.hash = hash;
    entry.triangle_count = static_cast<int>(soup_.size() / 3);
    resident_is_stale_ = true;
  }
  entry.changed = false;
  return entry.mesh;
}

std::shared_ptr<const Mesh> MeshStore::build(std::uint64_t hash, bool deformable) {
  std::weak_ptr<const Mesh>& known = by_content_[hash];
  if (auto mesh = known.lock()) return mesh;
  // The occupancy grid only saves rays: not worth its time for a mesh that changes in every step.
  auto mesh = std::make_shared<const Mesh>(
      build_mesh(soup_, {.open_thickness = open_thickness_, .occupancy_grid = !deformable}));
  known = mesh;
  if (!mesh->finite)
    log(LogLevel::kWarning, "a mesh of " + std::to_string(soup_.size() / 3) +
                                " triangles has a vertex that is not finite; its pairs get no "
                                "contacts");
  return mesh;
}

std::shared_ptr<const Mesh> MeshStore::known(dTriMeshDataID data, int triangle_count) const {
  const auto found = entries_.find(data);
  if (found == entries_.end() || found->second.changed ||
      found->second.triangle_count != triangle_count)
    return nullptr;
  return found->second.mesh;
}

void MeshStore::announce_change(dTriMeshDataID data) {
  const auto found = entries_.find(data);
  if (found != entries_.end()) found->second.changed = true;
}

void MeshStore::set_deformable(dTriMeshDataID data, bool deformable) {
  const auto [place, is_new] = entries_.try_emplace(data);
  if (is_new) place->second.order = next_order_++;
  place->second.deformable = deformable;
}

void MeshStore::forget(dTriMeshDataID data) {
  if (entries_.erase(data) != 0) resident_is_stale_ = true;
}

void MeshStore::clear() {
  std::erase_if(entries_, [](const auto& item) { return !item.second.deformable; });
  for (auto& [data, entry] : entries_) entry.mesh = nullptr;
  resident_is_stale_ = true;
}

void MeshStore::prune(std::uint64_t pass) {
  const std::size_t removed = std::erase_if(entries_, [&](const auto& item) {
    return item.second.mesh != nullptr && item.second.last_pass + kPassesKept < pass;
  });
  if (removed != 0) resident_is_stale_ = true;
}

const std::vector<std::shared_ptr<const Mesh>>& MeshStore::resident() {
  if (!resident_is_stale_) return resident_;
  std::vector<const Entry*> ordered;
  for (const auto& [data, entry] : entries_)
    if (entry.mesh != nullptr) ordered.push_back(&entry);
  std::sort(ordered.begin(), ordered.end(),
            [](const Entry* a, const Entry* b) { return a->order < b->order; });
  resident_.clear();
  index_.clear();
  for (const Entry* entry : ordered)
    if (index_.emplace(entry->mesh.get(), static_cast<std::uint32_t>(resident_.size())).second)
      resident_.push_back(entry->mesh);
  std::erase_if(by_content_, [](const auto& item) { return item.second.expired(); });
  resident_is_stale_ = false;
  return resident_;
}

}  // namespace ode_ext
