// SPDX-License-Identifier: BSD-3-Clause
#include "ode/answers.h"

#include <cstring>
#include <functional>

namespace ode_ext {
namespace {

bool same(const PairMember& a, const PairMember& b) {
  return a.geom == b.geom && a.data == b.data && a.mesh == b.mesh &&
         std::memcmp(&a.pose, &b.pose, sizeof(Pose)) == 0;
}

}  // namespace

static_assert(sizeof(Pose) == 12 * sizeof(double), "poses are compared by their bytes");

bool Answer::holds(const PairMember& a, const PairMember& b) const {
  return valid && ((same(members[0], a) && same(members[1], b)) ||
                   (same(members[0], b) && same(members[1], a)));
}

Answer* Answers::find(dGeomID a, dGeomID b) {
  const auto found = map_.find(key(a, b));
  return found == map_.end() ? nullptr : &found->second;
}

void Answers::prune(std::uint64_t pass) {
  std::erase_if(map_,
                [&](const auto& item) { return item.second.last_pass + kPassesRemembered < pass; });
}

Answers::Key Answers::key(dGeomID a, dGeomID b) {
  return std::less<>()(a, b) ? Key{a, b} : Key{b, a};
}

// Geoms come from an allocator: their low bits are equal and their differences regular, so the two
// are mixed by odd multipliers (of the golden ratio and of pi) and the high half is folded down.
std::size_t Answers::Hash::operator()(const Key& key) const {
  const std::uint64_t a = reinterpret_cast<std::uintptr_t>(key[0]);
  const std::uint64_t b = reinterpret_cast<std::uintptr_t>(key[1]);
  const std::uint64_t mixed = a * 0x9e3779b97f4a7c15u + b * 0x3243f6a8885a308du;
  return static_cast<std::size_t>(mixed ^ mixed >> 29);
}

bool in_canonical_order(const PairMember& a, const PairMember& b) {
  if (a.mesh->shape_hash != b.mesh->shape_hash) return a.mesh->shape_hash < b.mesh->shape_hash;
  const int poses = std::memcmp(&a.pose, &b.pose, sizeof(Pose));
  if (poses != 0) return poses < 0;
  if (a.mesh->content_hash != b.mesh->content_hash)
    return a.mesh->content_hash < b.mesh->content_hash;
  const int soups = compare_soups(a.mesh->soup, b.mesh->soup);  // hashes can be forged
  if (soups != 0) return soups < 0;
  // Copies at one pose: nothing of theirs tells them apart, so their handles have to.
  return std::less<>()(a.geom, b.geom);
}

}  // namespace ode_ext
