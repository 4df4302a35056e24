// SPDX-License-Identifier: BSD-3-Clause
// What a near callback collects: the contacts of one step, and nothing else, so that two colliders
// timed over the same callback do the same work in it.
#pragma once

#include <ode/ode.h>

#include <cstdint>
#include <span>
#include <vector>

namespace falling_objects {

// As dCollide.
using CollideFunction = int(dGeomID, dGeomID, int, dContactGeom*, int);

class ContactList {
 public:
  explicit ContactList(int max_contacts_per_pair) : limit_(max_contacts_per_pair) {}

  void clear();
  void collide(dGeomID g1, dGeomID g2, CollideFunction* function);

  long long pairs() const { return pairs_; }
  long long colliding_pairs() const { return colliding_pairs_; }
  std::span<const dContactGeom> contacts() const { return {contacts_.data(), count_}; }

 private:
  int limit_;
  long long pairs_ = 0;
  long long colliding_pairs_ = 0;
  std::size_t count_ = 0;
  std::vector<dContactGeom> contacts_;  // room for more than `count_`
};

// Mixes every bit of every contact, in order, into `hash`. Equal runs have equal hashes.
std::uint64_t hash_contacts(std::span<const dContactGeom> contacts, std::uint64_t hash);
inline constexpr std::uint64_t kHashStart = 0xcbf29ce484222325;  // of FNV-1a

}  // namespace falling_objects
