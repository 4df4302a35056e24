// SPDX-License-Identifier: BSD-3-Clause
// A scene of the pairs that have no answer yet, and the answers that it will be.
#pragma once

#include <cstdint>
#include <span>
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
                              std::uint64_t pass, PassMemory* memory);
  // Stores what was found, and of which pairs nothing is known, since the device has no room.
  void store(const PairContacts& found, std::span<const std::size_t> given_up, std::uint64_t look);
  // Whether it is of one pair, which the device has no room for: that is noted then.
  bool give_up_if_single(std::uint64_t look);
  // It will not be collided: its answers do not stand.
  void drop();
  // Answers with contacts, those that were there before among them.
  long long colliding() const { return colliding_; }

 private:
  std::uint32_t object_of(PairMember& member);
  const PairContacts& collide_with_room(Collider& collider, MeshStore& meshes, std::uint64_t pass,
                                        PassMemory* memory);
  void set_objects(MeshStore& meshes);

  Scene scene_;
  std::uint64_t number_ = 0;
  std::vector<const PairMember*> members_;  // its objects
  std::vector<Answer*> pending_;            // of its pairs
  long long colliding_ = 0;
};

}  // namespace ode_ext
