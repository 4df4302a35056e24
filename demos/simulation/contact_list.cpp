// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/contact_list.h"

#include <algorithm>
#include <bit>

#include "simulation/scene.h"

namespace falling_objects {
namespace {

constexpr int kNoLimit = 0xffff;  // the most that dCollide's flags can say

}  // namespace

void ContactList::clear() {
  count_ = 0;
  pairs_ = 0;
  colliding_pairs_ = 0;
}

void ContactList::collide(dGeomID g1, dGeomID g2, CollideFunction* function) {
  // A sheet lies on what it touches with hundreds of vertices, and needs a contact for each.
  const bool sheet = ((dGeomGetCategoryBits(g1) | dGeomGetCategoryBits(g2)) & kSheetBit) != 0;
  const int limit = sheet ? kNoLimit : limit_;
  const std::size_t room = count_ + static_cast<std::size_t>(limit);
  if (contacts_.size() < room) contacts_.resize(std::max(room, 2 * contacts_.size()));
  const int found = function(g1, g2, limit, &contacts_[count_], sizeof(dContactGeom));
  ++pairs_;
  colliding_pairs_ += found > 0;
  count_ += static_cast<std::size_t>(found);
}

// FNV-1a, over words rather than bytes: eight times as fast, and all that is asked is to differ.
std::uint64_t hash_contacts(std::span<const dContactGeom> contacts, std::uint64_t hash) {
  const auto mix = [&](std::uint64_t word) {
    hash = (hash ^ word) * 0x100000001b3;
    hash ^= hash >> 32;  // a multiplication alone carries no high bit down
  };
  const auto mix_real = [&](dReal x) { mix(std::bit_cast<std::uint64_t>(static_cast<double>(x))); };
  for (const dContactGeom& contact : contacts) {
    for (int k = 0; k < 3; ++k) mix_real(contact.pos[k]);
    for (int k = 0; k < 3; ++k) mix_real(contact.normal[k]);
    mix_real(contact.depth);
    mix(index_of(contact.g1));
    mix(index_of(contact.g2));
    mix(static_cast<std::uint64_t>(contact.side1));
    mix(static_cast<std::uint64_t>(contact.side2));
  }
  return hash;
}

}  // namespace falling_objects
