// SPDX-License-Identifier: BSD-3-Clause
#include "ode/pair_scene.h"

#include <unordered_set>

#include "ode/capture.h"
#include "opencl/error.h"

namespace ode_ext {

void PairScene::begin() {
  scene_.objects.clear();
  scene_.pairs.clear();
  scene_.features.clear();
  members_.clear();
  ++number_;
  colliding_ = 0;
  changed_ = 0;
}

void PairScene::add(Answer& answer, PairMember& a, PairMember& b, bool can_collide) {
  if (answer.holds(a, b)) {
    colliding_ += answer.contacts.empty() ? 0 : 1;
    return;
  }
  ++changed_;
  const bool ordered = in_canonical_order(a, b);
  PairMember &first = ordered ? a : b, &second = ordered ? b : a;
  answer.geoms = {first.geom, second.geom};
  answer.stamps = {first.stamp, second.stamp};
  answer.contacts.clear();
  answer.valid = false;
  if (can_collide) {
    scene_.pairs.push_back({object_of(first), object_of(second)});
    scene_.features.push_back(answer.features);
    pending_.push_back(&answer);
    answer.given_up = 0;
  }
  // That there are no contacts is the answer of most pairs, and of those of which nothing can be
  // said. So it stands, unless the scene fails, and most are not touched again.
  answer.valid = true;
}

std::uint32_t PairScene::object_of(PairMember& member) {
  if (member.object_of != number_) {
    member.object_of = number_;
    member.object = static_cast<std::uint32_t>(members_.size());
    members_.push_back(&member);
  }
  return member.object;
}

const PairContacts& PairScene::collide(const void* identity, Collider& collider, MeshStore& meshes,
                                       std::uint64_t round, PassMemory* memory) {
  const auto captured = capture_pass(identity, members_, scene_.pairs);
  const PairContacts& found = collide_with_room(collider, meshes, round, memory);
  const BatchReport& report = collider.report();
  if (report.given_up.empty() && !report.backtracked) capture_contacts(captured, found);
  return found;
}

// All meshes that are known stay on the device, those of this scene or not, as long as it has room.
const PairContacts& PairScene::collide_with_room(Collider& collider, MeshStore& meshes,
                                                 std::uint64_t round, PassMemory* memory) {
  for (;;) {
    set_objects(meshes);
    try {
      return collider.collide(scene_, memory);
    } catch (const DeviceError& error) {
      std::unordered_set<const Mesh*> used;
      for (const PairMember* member : members_) used.insert(member->mesh.get());
      if (!is_out_of_memory(error.code()) || !meshes.make_room(used, round)) throw;
    }
  }
}

void PairScene::set_objects(MeshStore& meshes) {
  const auto& resident = meshes.resident();
  if (meshes_number_ != meshes.resident_number()) scene_.meshes = resident;
  meshes_number_ = meshes.resident_number();
  scene_.objects.clear();
  for (const PairMember* member : members_)
    scene_.objects.push_back({member->pose, meshes.index_of(member->mesh.get()),
                              reinterpret_cast<std::uintptr_t>(member->geom)});
}

void PairScene::give_up(std::size_t pair, std::uint64_t pass) {
  Answer& answer = *pending_[pair];
  answer.valid = false;
  answer.given_up = pass;
  for (std::size_t k = 0; k < 2; ++k)
    answer.given_up_meshes[k] = members_[scene_.pairs[pair][k]]->mesh->topology.get();
}

void PairScene::store(const PairContacts& found) {
  for (std::size_t i = 0; i < pending_.size(); ++i) {
    if (i + kAhead < pending_.size() && found.ranges[i + kAhead].count != 0)
      pending_[i + kAhead]->prefetch();
    const PairContacts::Range range = found.ranges[i];
    // Most have none, as before, and are not touched.
    if (range.features != scene_.features[i]) pending_[i]->features = range.features;
    if (range.count == 0) continue;
    const auto first = found.contacts.begin() + static_cast<std::ptrdiff_t>(range.first);
    pending_[i]->contacts.assign(first, first + range.count);
    ++colliding_;
  }
  pending_.clear();
}

void PairScene::drop() {
  for (Answer* answer : pending_) answer->valid = false;
  pending_.clear();
}

}  // namespace ode_ext
