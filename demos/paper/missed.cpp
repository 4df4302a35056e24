// SPDX-License-Identifier: BSD-3-Clause
#include "paper/missed.h"

#include <algorithm>
#include <map>
#include <utility>

namespace paper {
namespace {

using Pair = std::pair<dGeomID, dGeomID>;

std::map<Pair, long long> contacts_of_pairs(std::span<const dContactGeom> contacts) {
  std::map<Pair, long long> counts;
  for (const dContactGeom& contact : contacts) ++counts[std::minmax(contact.g1, contact.g2)];
  return counts;
}

}  // namespace

Missed& Missed::operator+=(const Missed& other) {
  pairs += other.pairs;
  contacts += other.contacts;
  missed_pairs += other.missed_pairs;
  missed_contacts += other.missed_contacts;
  false_pairs += other.false_pairs;
  return *this;
}

Missed compare_contacts(std::span<const dContactGeom> all, std::span<const dContactGeom> found) {
  const auto counts = contacts_of_pairs(all);
  auto rest = contacts_of_pairs(found);
  Missed missed;
  missed.pairs = static_cast<long long>(counts.size());
  missed.contacts = static_cast<long long>(all.size());
  for (const auto& [pair, count] : counts) {
    const auto other = rest.find(pair);
    const long long there = other == rest.end() ? 0 : other->second;
    missed.missed_pairs += there == 0;
    missed.missed_contacts += std::max(0LL, count - there);
    if (other != rest.end()) rest.erase(other);
  }
  missed.false_pairs = static_cast<long long>(rest.size());
  return missed;
}

}  // namespace paper
