// SPDX-License-Identifier: BSD-3-Clause
#include "ode/known_contacts.h"

#include <cstdint>
#include <unordered_map>

namespace ode_ext {
namespace {

// Compared as numbers, in ODE's precision: between here and the program ODE may have turned a 0
// into -0.
bool is_where(const Contact& known, const dContactGeom& contact, bool swapped) {
  for (std::size_t k = 0; k < 3; ++k)
    if (static_cast<dReal>(known.position[k]) != contact.pos[k] ||
        static_cast<dReal>(known.normal[k]) != (swapped ? -contact.normal[k] : contact.normal[k]))
      return false;
  return static_cast<dReal>(known.depth) == contact.depth;
}

bool has_sides(const Contact& known, const dContactGeom& contact, bool swapped) {
  return static_cast<int>(known.triangles[swapped ? 1 : 0]) == contact.side1 &&
         static_cast<int>(known.triangles[swapped ? 0 : 1]) == contact.side2;
}

// The raw numbers of regions are as they came; these are by the first contact of each.
std::vector<int> numbered(std::span<const Contact> contacts) {
  std::vector<int> regions;
  std::unordered_map<std::uint32_t, int> numbers;
  for (const Contact& contact : contacts)
    regions.push_back(
        numbers.try_emplace(contact.region, static_cast<int>(numbers.size())).first->second);
  return regions;
}

}  // namespace

std::size_t KnownContacts::find(const dContactGeom& contact) {
  const bool swapped = contact.g1 != first_;
  // Sides tell apart those in one place, but callbacks of the program may have changed them.
  std::size_t found = known_.size();
  for (std::size_t i = 0; i < known_.size(); ++i) {
    const std::size_t k = (next_ + i) % known_.size();
    if (!is_where(known_[k], contact, swapped)) continue;
    const bool certain = has_sides(known_[k], contact, swapped);
    if (certain || found == known_.size()) found = k;
    if (certain) break;
  }
  if (found != known_.size()) next_ = found + 1;
  return found;
}

dBatchContactId KnownContacts::id_of(const dContactGeom& contact) {
  const std::size_t found = find(contact);
  if (found == known_.size()) return kNoContactId;
  const bool swapped = contact.g1 != first_;
  const auto& features = known_[found].features;
  return {features[swapped ? 1 : 0], features[swapped ? 0 : 1]};
}

dBatchContactRegion KnownContacts::region_of(const dContactGeom& contact) {
  const std::size_t found = find(contact);
  if (found == known_.size()) return kNoContactRegion;
  if (regions_.empty()) regions_ = numbered(known_);
  const std::uint32_t within = known_[found].within;
  if (within == 0) return {regions_[found], dBatchOverlapCrossing};
  const bool first = (within == 1) == (contact.g1 == first_);
  return {regions_[found], first ? dBatchOverlapFirstInside : dBatchOverlapSecondInside};
}

}  // namespace ode_ext
