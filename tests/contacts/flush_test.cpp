// SPDX-License-Identifier: BSD-3-Clause
// Bodies with sides in one plane: what lies on the side of the other is not out by that, where its
// own body goes on behind it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "contacts/placed.h"
#include "support/extruded.h"

namespace ode_ext::test {
namespace {

Profile star_of(int points, double inner, double outer) {
  Profile profile;
  for (int i = 0; i < 2 * points; ++i) {
    const double angle = std::numbers::pi * i / points, r = i % 2 == 0 ? outer : inner;
    profile.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return profile;
}

// The one on the other, whose top is z = 0, and as deep in it. Each corner of the upper one lies on
// two sides of the lower one and would leave by either, by nothing.
void expect_held(const TestMesh& mesh, double high, const TestPose& turn, double deep,
                 const std::string& name) {
  TestPose upper = turn;
  upper.position[2] = high / 2 - deep;
  const TestPose lower = at(0, 0, -high / 2);
  for (const bool is_first : {true, false}) {
    const Placed placed =
        is_first ? Placed{mesh, mesh, upper, lower} : Placed{mesh, mesh, lower, upper};
    const std::vector<Contact> found = placed.contacts(TestPose{});
    double held = 0;
    for (const Contact& c : found)
      if ((is_first ? c.normal.z : -c.normal.z) > 0.99) held = std::max(held, c.depth);
    EXPECT_NEAR(held, deep, placed.tolerance(TestPose{})) << name << ", " << deep << " deep";
    EXPECT_LT(deepest(found), deep + placed.tolerance(TestPose{})) << name << ", " << deep;
  }
}

TEST(Flush, BodiesThatLieOnTheirLikeAreHeldByAllThatTheyAreInIt) {
  const std::vector<std::pair<std::string, Profile>> profiles{
      {"L", {{0, 0}, {0.3, 0}, {0.3, 0.1}, {0.1, 0.1}, {0.1, 0.3}, {0, 0.3}}},
      {"T",
       {{-0.05, 0},
        {0.05, 0},
        {0.05, 0.2},
        {0.2, 0.2},
        {0.2, 0.3},
        {-0.2, 0.3},
        {-0.2, 0.2},
        {-0.05, 0.2}}},
      {"U",
       {{0, 0}, {0.3, 0}, {0.3, 0.3}, {0.2, 0.3}, {0.2, 0.1}, {0.1, 0.1}, {0.1, 0.3}, {0, 0.3}}},
      {"star", star_of(5, 0.12, 0.3)}};
  for (const auto& [name, profile] : profiles) {
    const TestMesh mesh = extruded(profile, 0.2);
    for (const double aside : {0.0, 1e-6, 1e-5, 1e-4})
      for (const double deep : {1e-4, 1e-3, 5e-3, 2e-2})
        expect_held(mesh, 0.2, at(aside, 0.6 * aside, 0), deep, name);
  }
}

TEST(Flush, RingsThatLieOnTheirLikeAreHeldHoweverTheyAreTurned) {
  Random random(3);
  for (const int sides : {8, 16, 32, 96}) {
    const TestMesh ring = hub(polygon(sides, 0.1), 0.2, 0.2);
    for (int i = 0; i < 40; ++i)
      expect_held(ring, 0.2, turned({0, 0, 1}, random.uniform(0, 6.28)), random.uniform(1e-4, 5e-3),
                  std::to_string(sides) + " sides");
  }
}

}  // namespace
}  // namespace ode_ext::test
