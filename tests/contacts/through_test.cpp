// SPDX-License-Identifier: BSD-3-Clause
// Thin bodies that have gone through others and come out: no vertex of theirs is inside.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "contacts/placed.h"
#include "contacts/upright.h"
#include "support/convex_makers.h"
#include "support/convex_solid.h"
#include "support/extruded.h"

namespace ode_ext::test {
namespace {

// A plate that is moved by as much as a spike is wide there is around it at another height.
TEST(Through, SpikesThatHaveComeOutOfAPlateGoBackUp) {
  const double height = 0.5;
  Random random(21);
  for (const double thickness : {0.01, 0.05, 0.1})
    for (const double half : {2., 4., 8., 14., 18., 24.})
      for (const int sides : {3, 4, 6, 24})
        for (int i = 0; i < 4; ++i) {
          const TestMesh spike = make_cone(height * std::tan(radians(half)), height, sides);
          const double deep = thickness + random.uniform(0.01, 0.12);
          TestPose pose = tilted(random, 0.2, turned({1, 0, 0}, std::numbers::pi));
          pose.position = {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2),
                           -lowest_of(spike, pose)[2] - deep};
          const Placed placed{spike, make_box({2, 2, thickness}), pose, at(0, 0, -thickness / 2)};
          const std::vector<Contact> found = placed.contacts(TestPose{});
          SCOPED_TRACE(std::to_string(half) + " degrees, " + std::to_string(sides) + " sides");
          ASSERT_FALSE(found.empty());
          EXPECT_GT(deepest(found), 0.99 * thickness);
          EXPECT_LT(deepest(found), deep + 5e-5);
          for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.99);
        }
}

TEST(Through, RodsGoBackUpFromAPlateAndOutByItsRimWhereThatIsNearer) {
  const double thickness = 0.04, width = 0.05;
  const TestMesh rod = make_box({width, width, 1}), plate = make_box({0.8, 0.8, thickness});
  Random random(22);
  for (int i = 0; i < 40; ++i)
    for (const bool at_rim : {false, true}) {
      const double deep = thickness + (at_rim ? 0.4 : random.uniform(0.02, 0.2));
      TestPose pose = tilted(random, 0.1, TestPose{});
      pose.position = {at_rim ? 0.36 : random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1),
                       -lowest_of(rod, pose)[2] - deep};
      const Placed placed{rod, plate, pose, at(0, 0, -thickness / 2)};
      const std::vector<Contact> found = placed.contacts(TestPose{});
      ASSERT_FALSE(found.empty());
      const Vec3d& normal = found.front().normal;
      EXPECT_GT(at_rim ? normal.x : normal.z, 0.98);
    }
}

// By the deepest contact, again and again, as a program that undoes them does: no contact is deeper
// than what meets there is thick. A plane through which a body is not seen to come back is taken
// for up to twice the least.
TEST(Through, ThinBodiesInOneAnotherArePartedByHardlyMoreThanTheLeastWay) {
  const std::vector<TestMesh> bodies{make_box({0.8, 0.8, 0.04}),
                                     make_box({0.9, 0.15, 0.03}),
                                     make_box({0.05, 0.05, 1}),
                                     make_cone(0.05, 0.6, 6),
                                     make_cone(0.03, 0.7, 3),
                                     make_cylinder(0.2, 0.3, 16),
                                     extruded({{0, 0}, {0.02, 0.3}, {-0.02, 0.3}}, 0.6)};
  std::vector<ConvexSolid> solids;
  for (const TestMesh& body : bodies) solids.emplace_back(body);
  Random random(23);
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a; b < bodies.size(); ++b)
      for (int i = 0; i < 12;) {
        Placed placed{bodies[a], bodies[b], random.pose(0.3), TestPose{}};
        const double least = shortest_way_out(solids[a], placed.pa, solids[b], placed.pb).depth;
        if (least < 1e-3) continue;
        ++i;
        SCOPED_TRACE(std::to_string(a) + " in " + std::to_string(b) + ", pose " +
                     std::to_string(i));
        double way = 0;
        std::vector<Contact> found = placed.contacts(TestPose{});
        for (int round = 0; round < 24 && !found.empty(); ++round) {
          const Contact first = found.front();
          const double moved = first.depth + placed.tolerance(TestPose{});
          placed.pa.position = placed.pa.position + moved * point_of(first.normal);
          way += moved;
          found = placed.contacts(TestPose{});
        }
        EXPECT_TRUE(found.empty());
        EXPECT_LT(way, 2 * least);
      }
}

}  // namespace
}  // namespace ode_ext::test
