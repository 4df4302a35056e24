// SPDX-License-Identifier: BSD-3-Clause
// A scene of the pairs that have no answer yet, and the answers that it will be.
#pragma once

#include <cstdint>
#include <vector>

#include "collide/collider.h"
#include "ode/answers.h"
#include "ode/members.h"
#include "ode/mesh_store.h"

namespace ode_ext {

class PairScene {
 public:
  void begin();
  // Another for each scene begun.
  std::uint64_t number() const { return number_; }
  // Unless the answer is one of these two already. can_collide: something can be said of them.
  // Members and answer have to stay where they are until the scene is collided or dropped.
  void add(Answer& answer, PairMember& a, PairMember& b, bool can_collide);
  // `identity`: by which a capture knows whose it is. Throws DeviceError; the scene is to be
  // dropped then.
  const PairContacts& collide(const void* identity, Collider& collider, MeshStore& meshes,
                              std::uint64_t round, PassMemory* memory);
  // The device has no room for a pair of it: its answer does not stand.
  void give_up(std::size_t pair, std::uint64_t pass);
  // Stores what was found of the others.
  void store(const PairContacts& found);
  std::size_t size() const { return pending_.size(); }
  // It will not be collided: its answers do not stand.
  void drop();
  // Answers with contacts, those that were there before among them.
  long long colliding() const { return colliding_; }
  // Those whose answer is made anew.
  std::size_t changed() const { return changed_; }

 private:
  std::uint32_t object_of(PairMember& member);
  const PairContacts& collide_with_room(Collider& collider, MeshStore& meshes, std::uint64_t round,
                                        PassMemory* memory);
  void set_objects(MeshStore& meshes);

  Scene scene_;
  std::uint64_t meshes_number_ = 0;  // of its meshes (MeshStore::resident_number)
  std::uint64_t number_ = 0;
  std::vector<const PairMember*> members_;  // its objects
  std::vector<Answer*> pending_;            // of its pairs
  long long colliding_ = 0;
  std::size_t changed_ = 0;
};

}  // namespace ode_ext
