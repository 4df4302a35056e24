// SPDX-License-Identifier: BSD-3-Clause
#include "support/convex_solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/ccd_oracle.h"
#include "support/convex_makers.h"
#include "support/fcl_oracle.h"

namespace ode_ext::test {
namespace {

TEST(ConvexSolid, LeavesEdgesWithinFlatFacesOut) {
  EXPECT_EQ(ConvexSolid(make_cube(1, 3)).edges().size(), 36u);  // a cube's twelve in thirds
  EXPECT_EQ(ConvexSolid(make_cylinder(1, 1, 16)).edges().size(), 48u);
  EXPECT_EQ(ConvexSolid(make_icosphere(1, 1)).edges().size(), 120u);
}

TEST(ShortestWayOut, OfAlignedBoxesIsTheirOverlap) {
  const ConvexSolid box(make_box({2, 4, 6}));
  const WayOut out = shortest_way_out(box, at(1.9, 0.3, -0.2), box, at(0, 0, 0));
  EXPECT_NEAR(out.depth, 0.1, 1e-9);
  EXPECT_LT(distance(out.direction, {1, 0, 0}), 1e-9);
  EXPECT_NEAR(shortest_way_out(box, at(0, 0, -6.5), box, at(0, 0, 0)).depth, -0.5, 1e-9);
}

TEST(ShortestWayOut, OfCrossedRodsIsAlongTheCrossProductOfTheirEdges) {
  const ConvexSolid rod(make_rod(4, 0.5));
  const TestPose lower = turned({1, 0, 0}, std::numbers::pi / 4, {1, 2, 3});
  TestPose upper = composed(turned({0, 0, 1}, 0.7), turned({1, 0, 0}, std::numbers::pi / 4));
  upper.position = lower.position + Point{0.1, 0.05, 0.5 * std::sqrt(2.0) - 0.02};
  const WayOut out = shortest_way_out(rod, upper, rod, lower);
  EXPECT_NEAR(out.depth, 0.02, 1e-6);
  EXPECT_LT(distance(out.direction, {0, 0, 1}), 1e-6);
}

// Every edge lies on its copy, and spans nothing with it.
TEST(ShortestWayOut, OfACopyIsTheLeastWidth) {
  Random random(9);
  for (int trial = 0; trial < 20; ++trial) {
    const ConvexSolid hull(make_random_hull(random, 20, 0.5));
    const TestPose pose = random.pose(1);
    const WayOut out = shortest_way_out(hull, pose, hull, pose);
    EXPECT_GT(out.depth, 0.4);  // a ball of radius 0.3 is about filled
    EXPECT_NEAR(way_out_along(out.direction, hull, pose, hull, pose), out.depth, 1e-6);
  }
  const ConvexSolid brick(make_box({1, 0.5, 0.25}));
  EXPECT_NEAR(shortest_way_out(brick, {}, brick, {}).depth, 0.25, 1e-9);
}

TEST(WayOutAlong, ADirectionIsTheExtentOfBothAlongIt) {
  const ConvexSolid cube(make_cube(2));
  const TestPose a = at(0, 0, 1.5), b = at(0, 0, 0);
  EXPECT_NEAR(way_out_along({0, 0, 1}, cube, a, cube, b), 0.5, 1e-9);
  EXPECT_NEAR(way_out_along({0, 0, -1}, cube, a, cube, b), 3.5, 1e-9);
  EXPECT_NEAR(way_out_along({1, 0, 0}, cube, a, cube, b), 2, 1e-9);
}

// Three things at once that nothing but the true shortest way has: it parts the two, it is no
// longer than the way along any other direction, and libccd finds none shorter.
TEST(ShortestWayOut, OfRandomPairsIsTheShortest) {
  Random random(3);
  const auto any = [&]() -> TestMesh {
    switch (random.below(5)) {
      case 0:
        return make_cube(1);
      case 1:
        return make_tetrahedron(1.2);
      case 2:
        return make_cylinder(0.5, 1, 12);
      case 3:
        return make_cone(0.5, 1, 12);
      default:
        return make_random_hull(random, 20, 0.6);
    }
  };
  int overlapping = 0, as_libccd = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const TestMesh ma = any(), mb = any();
    const TestPose pa = random.pose(0.6), pb = random.pose(0.6);
    const ConvexSolid a(ma), b(mb);
    const WayOut out = shortest_way_out(a, pa, b, pb);
    if (out.depth < 1e-4) {
      EXPECT_EQ(convex_penetration(ma, pa, mb, pb).overlap, out.depth > 0);
      continue;
    }
    ++overlapping;
    EXPECT_NEAR(length(out.direction), 1, 1e-12);
    EXPECT_NEAR(way_out_along(out.direction, a, pa, b, pb), out.depth, 1e-5);
    for (int i = 0; i < 200; ++i)
      EXPECT_GT(way_out_along(random.direction(), a, pa, b, pb), out.depth - 1e-5);
    TestPose parted = pa;
    parted.position = pa.position + (out.depth + 1e-4) * out.direction;
    EXPECT_FALSE(surfaces_intersect(ma, parted, mb, pb));
    const ConvexPenetration ccd = convex_penetration(ma, pa, mb, pb);
    if (std::fabs(ccd.depth - out.depth) < 1e-4) {
      ++as_libccd;
    } else {  // then it is libccd that is wrong: it found a longer way, or one that does not part
      EXPECT_TRUE(ccd.depth > out.depth ||
                  way_out_along(ccd.direction, a, pa, b, pb) > ccd.depth + 1e-4);
    }
  }
  EXPECT_GT(overlapping, 100);
  EXPECT_GE(as_libccd, overlapping * 95 / 100);  // libccd stops early a few times in hundreds
}

}  // namespace
}  // namespace ode_ext::test
