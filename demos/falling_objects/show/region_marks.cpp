// SPDX-License-Identifier: BSD-3-Clause
#include "falling_objects/show/region_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <map>
#include <tuple>

#include "falling_objects/show/mesh_of_geom.h"
#include "simulation/scene.h"

namespace falling_objects {
namespace {

// Brighter than objects are.
constexpr std::array<view::Color, 7> kRegions{{{1.0F, 0.15F, 0.10F},
                                               {0.10F, 0.85F, 0.20F},
                                               {0.15F, 0.40F, 1.0F},
                                               {1.0F, 0.85F, 0.0F},
                                               {0.95F, 0.10F, 0.90F},
                                               {0.0F, 0.90F, 0.95F},
                                               {1.0F, 0.55F, 0.0F}}};

std::size_t number_of(const dContactGeom& contact, const dBatchContactRegion& region) {
  const auto [low, high] = std::minmax({index_of(contact.g1), index_of(contact.g2)});
  return (3 * low + 5 * high + static_cast<std::size_t>(region.region)) % kRegions.size();
}

// Two directions along a surface.
std::array<glm::vec3, 2> along(glm::vec3 normal) {
  const glm::vec3 aside = std::abs(normal.z) < 0.9F ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0);
  const glm::vec3 x = glm::normalize(glm::cross(aside, normal));
  return {x, glm::cross(normal, x)};
}

// The polygon around a point.
void fan(glm::vec3 middle, const std::vector<glm::vec3>& around, view::Patch& patch) {
  for (std::size_t i = 0; i < around.size(); ++i) {
    patch.corners.insert(patch.corners.end(), {middle, around[i], around[(i + 1) % around.size()]});
  }
}

void add_spot(glm::vec3 at, glm::vec3 normal, float radius, view::Patch& patch) {
  constexpr std::size_t kSides = 10;
  const auto [x, y] = along(normal);
  std::vector<glm::vec3> around;
  for (std::size_t i = 0; i < kSides; ++i) {
    const float angle = glm::two_pi<float>() * static_cast<float>(i) / kSides;
    around.push_back(at + radius * (std::cos(angle) * x + std::sin(angle) * y));
  }
  fan(at, around, patch);
}

// Round about their middle, as seen along the normal of the first.
void add_span(const std::vector<const dContactGeom*>& contacts, view::Patch& patch) {
  if (contacts.size() < 3) return;
  glm::vec3 middle(0);
  std::vector<glm::vec3> places;
  for (const dContactGeom* contact : contacts) {
    places.push_back(to_glm(contact->pos));
    middle += places.back() / static_cast<float>(contacts.size());
  }
  const auto [x, y] = along(to_glm(contacts.front()->normal));
  const auto angle = [&, x = x, y = y](glm::vec3 place) {
    return std::atan2(glm::dot(place - middle, y), glm::dot(place - middle, x));
  };
  std::sort(places.begin(), places.end(),
            [&](const auto& a, const auto& b) { return angle(a) < angle(b); });
  fan(middle, places, patch);
}

}  // namespace

std::vector<dBatchContactRegion> regions_of(dBatchColliderID collider,
                                            std::span<const dContactGeom> contacts) {
  std::vector<dBatchContactRegion> regions(contacts.size(), {-1, dBatchOverlapNone});
  dBatchColliderGetContactRegions(collider, contacts.data(), static_cast<int>(contacts.size()),
                                  sizeof(dContactGeom), regions.data());
  return regions;
}

view::Color color_of(const dContactGeom& contact, const dBatchContactRegion& region) {
  return kRegions[number_of(contact, region)];
}

void mark_regions(std::span<const dContactGeom> contacts,
                  std::span<const dBatchContactRegion> regions, float radius,
                  std::vector<view::Patch>& patches) {
  std::vector<view::Patch> by_color;
  for (const view::Color& color : kRegions) by_color.push_back({{}, color, true});
  std::map<std::tuple<dGeomID, dGeomID, int>, std::vector<const dContactGeom*>> members;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (regions[i].region < 0) continue;
    const dContactGeom& contact = contacts[i];
    members[{contact.g1, contact.g2, regions[i].region}].push_back(&contact);
    add_spot(to_glm(contact.pos), to_glm(contact.normal), radius,
             by_color[number_of(contact, regions[i])]);
  }
  for (const auto& [region, its] : members) {
    const dBatchContactRegion number{std::get<2>(region), dBatchOverlapNone};
    add_span(its, by_color[number_of(*its.front(), number)]);
  }
  for (view::Patch& patch : by_color) {
    if (!patch.corners.empty()) patches.push_back(std::move(patch));
  }
}

}  // namespace falling_objects
