// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/getters.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "support/ode_world.h"

namespace ode_ext::fuzz {
namespace {

constexpr int kMostTriangles = 16;  // of a meshlet

std::string known_of(std::size_t count, int known, const char* what) {
  if (known == static_cast<int>(count)) return "";
  return "of " + std::to_string(count) + " contacts " + std::to_string(known) + " have " + what;
}

int exchanged(int overlap) {
  if (overlap == dBatchOverlapFirstInside) return dBatchOverlapSecondInside;
  return overlap == dBatchOverlapSecondInside ? int{dBatchOverlapFirstInside} : overlap;
}

int regions_of(dBatchColliderID collider, std::span<const dContactGeom> contacts,
               std::vector<dBatchContactRegion>& regions) {
  regions.assign(contacts.size(), {-7, -7});
  return dBatchColliderGetContactRegions(collider, contacts.data(),
                                         static_cast<int>(contacts.size()), sizeof(dContactGeom),
                                         regions.data());
}

bool two_corners_are_one(const test::TestMesh& mesh, std::size_t triangle) {
  const auto a = mesh.corner(triangle, 0), b = mesh.corner(triangle, 1),
             c = mesh.corner(triangle, 2);
  return a == b || b == c || c == a;
}

}  // namespace

std::string unidentified(dBatchColliderID collider, std::span<const dContactGeom> contacts) {
  std::vector<dBatchContactId> ids(contacts.size());
  const int known =
      dBatchColliderGetContactIds(collider, contacts.data(), static_cast<int>(contacts.size()),
                                  sizeof(dContactGeom), ids.data());
  const std::string unknown = known_of(contacts.size(), known, "an id");
  if (!unknown.empty()) return unknown;
  std::set<std::pair<unsigned, unsigned>> different;
  for (const dBatchContactId id : ids) different.insert({id.feature1, id.feature2});
  return different.size() == ids.size() ? "" : "two contacts of a pair have one id";
}

std::string misnumbered(const Regions& regions) {
  std::vector<int> overlaps;  // by region; -1: none of its contacts was met yet
  for (const auto [region, overlap] : regions.found) {
    if (region < 0) return "the region of a contact is not known";
    const bool is_known = overlap >= dBatchOverlapCrossing && overlap <= dBatchOverlapSecondInside;
    if (!is_known && (regions.crosses || overlap != dBatchOverlapNone))
      return "a region overlaps in a way of which there is none, " + std::to_string(overlap);
    const auto number = static_cast<std::size_t>(region);
    if (number > overlaps.size() && regions.in_order)
      return "region " + std::to_string(region) + " comes before a lower one";
    if (number >= overlaps.size()) {
      overlaps.resize(number, -1);
      overlaps.push_back(overlap);
    }
    if (overlaps[number] == -1) overlaps[number] = overlap;
    if (overlaps[number] != overlap) return "two contacts of a region overlap in two ways";
  }
  return "";
}

std::string misplaced(dBatchColliderID collider, std::span<const dContactGeom> contacts,
                      bool in_order, bool crosses) {
  std::vector<dBatchContactRegion> regions, others;
  const int known = regions_of(collider, contacts, regions);
  const std::string unknown = known_of(contacts.size(), known, "a region");
  if (!unknown.empty()) return unknown;
  const std::string flaw = misnumbered({regions, in_order, crosses});
  if (!flaw.empty()) return flaw;
  const test::Contacts other_way = test::flipped(test::Contacts(contacts.begin(), contacts.end()));
  if (regions_of(collider, other_way, others) != known)
    return "contacts turned round are in no region";
  const bool alike =
      std::equal(regions.begin(), regions.end(), others.begin(), [](const auto& a, const auto& b) {
        return a.region == b.region && a.overlap == exchanged(b.overlap);
      });
  return alike ? "" : "contacts turned round are in other regions";
}

std::string scattered(std::span<const int> meshlets, int count, const test::TestMesh& mesh) {
  if (count < 0 || static_cast<std::size_t>(count) > meshlets.size())
    return "there are " + std::to_string(count) + " meshlets";
  std::vector<int> sizes(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < meshlets.size(); ++i) {
    if (meshlets[i] < -1 || meshlets[i] >= count)
      return "a triangle is in meshlet " + std::to_string(meshlets[i]) + " of " +
             std::to_string(count);
    if (meshlets[i] >= 0) ++sizes[static_cast<std::size_t>(meshlets[i])];
    if (count > 0 && (meshlets[i] == -1) != two_corners_are_one(mesh, i))
      return meshlets[i] == -1 ? "a triangle is in no meshlet"
                               : "a triangle without three corners is in a meshlet";
  }
  for (const int size : sizes) {
    if (size == 0 || size > kMostTriangles)
      return "a meshlet has " + std::to_string(size) + " triangles";
  }
  return "";
}

}  // namespace ode_ext::fuzz
