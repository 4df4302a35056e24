// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/pressed_pair.h"

#include <gtest/gtest.h>

#include "support/convex_makers.h"
#include "support/fcl_oracle.h"

namespace ode_ext::accuracy {
namespace {

using test::operator+;
using test::operator*;

TEST(PressedPair, IsAsDeepAsAskedAndPartedByItsWayOut) {
  test::OdeWorld world;
  test::Random random(4);
  const Body cube(world, test::make_cube(1)), cone(world, test::make_cone(0.2, 0.6, 12));
  for (int trial = 0; trial < 50; ++trial) {
    const PressedPair pair = press_together(cube, cone, 0.05, random);
    EXPECT_NEAR(pair.out.depth, 0.05 * 0.6, 0.05 * 0.6 * 1e-3);
    const auto intersect_after = [&](double distance) {
      test::TestPose moved = pair.pa;
      moved.position = moved.position + distance * pair.out.direction;
      return surfaces_intersect(cube.mesh.mesh(), moved, cone.mesh.mesh(), pair.pb);
    };
    EXPECT_TRUE(intersect_after(pair.out.depth - 1e-5));
    EXPECT_FALSE(intersect_after(pair.out.depth + 1e-5));
  }
}

TEST(PressedPair, IsSeenAlikeByLibccd) {
  test::OdeWorld world;
  test::Random random(4);
  const Body cube(world, test::make_cube(1)), ball(world, test::make_icosphere(0.5, 1));
  int differing = 0;
  for (int trial = 0; trial < 100; ++trial)
    differing += libccd_differs(cube, ball, press_together(cube, ball, 0.05, random));
  EXPECT_LE(differing, 3);
  // And it would tell: another pose than the one the truth is of.
  PressedPair pair = press_together(cube, ball, 0.05, random);
  pair.pa.position = pair.pa.position + 0.01 * pair.out.direction;
  EXPECT_TRUE(libccd_differs(cube, ball, pair));
}

TEST(KnownPair, IsTurnedRoundWithItsDirection) {
  test::OdeWorld world;
  const Body cube(world, test::make_cube(1));
  const test::TestPose pose = test::at(0, 0, 0.9);
  const test::WayOut out{0.1, {0, 0, 1}};
  const KnownPair pair = make_known_pair(world, cube, pose, cube, {}, out, false);
  const KnownPair turned = make_known_pair(world, cube, pose, cube, {}, out, true);
  EXPECT_EQ(dGeomGetPosition(pair.geoms.first)[2], 0.9);
  EXPECT_EQ(dGeomGetPosition(turned.geoms.second)[2], 0.9);
  EXPECT_EQ(pair.direction[2], 1);
  EXPECT_EQ(turned.direction[2], -1);
}

TEST(KnownPair, TellsAFalseTruth) {
  test::OdeWorld world;
  const Body cube(world, test::make_cube(1));
  const test::TestPose pose = test::at(0.3, 0, 0.9);
  EXPECT_TRUE(is_shortest({0.1, {0, 0, 1}}, cube, pose, cube, {}));
  EXPECT_FALSE(is_shortest({0.11, {0, 0, 1}}, cube, pose, cube, {}));
  EXPECT_FALSE(is_shortest({0.1, {0, 0, -1}}, cube, pose, cube, {}));
}

}  // namespace
}  // namespace ode_ext::accuracy
