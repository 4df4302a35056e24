// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/ccd_oracle.h"
#include "support/fcl_oracle.h"

namespace ode_ext::test {
namespace {

TEST(FclOracle, SeesSpheresIntersectExactlyWhenTheyDo) {
  const TestMesh ball = make_icosphere(1, 3);  // facets lie at most 0.0032 inside the sphere
  EXPECT_EQ(surfaces_intersect_robustly(ball, at(1.95, 0, 0), ball, at(0, 0, 0)),
            OracleAnswer::Intersect);
  EXPECT_EQ(surfaces_intersect_robustly(ball, at(2.01, 0, 0), ball, at(0, 0, 0)),
            OracleAnswer::Apart);
}

TEST(FclOracle, SeesRodsThatCrossEdgeToEdge) {
  const TestMesh rod = make_rod(4, 0.5);
  const double half_diagonal = 0.25 * std::sqrt(2.0);
  const TestPose lower = turned({1, 0, 0}, std::numbers::pi / 4);
  const TestPose across = turned({0, 0, 1}, std::numbers::pi / 2);
  for (const double gap : {-0.01, 0.01}) {
    TestPose upper = composed(across, lower);
    upper.position = {0, 0, 2 * half_diagonal + gap};
    EXPECT_EQ(surfaces_intersect(rod, upper, rod, lower), gap < 0);
  }
}

TEST(FclOracle, CallsAHairsBreadthFragile) {
  const TestMesh cube = make_cube(1);
  EXPECT_EQ(surfaces_intersect_robustly(cube, at(1 + 1e-6, 0.3, 0.2), cube, at(0, 0, 0)),
            OracleAnswer::Fragile);
}

TEST(FclOracle, DoesNotSeeAMeshInsideAnother) {
  EXPECT_FALSE(surfaces_intersect(make_cube(1), at(0, 0, 0), make_cube(3), at(0, 0, 0)));
}

TEST(FclOracle, WorksFarFromTheOrigin) {
  const TestMesh cube = make_cube(1);
  EXPECT_TRUE(surfaces_intersect(cube, at(1e6 + 0.99, 0, 0), cube, at(1e6, 0.3, 0.2)));
  EXPECT_FALSE(surfaces_intersect(cube, at(1e6 + 1.01, 0, 0), cube, at(1e6, 0.3, 0.2)));
}

TEST(WindingNumber, IsOneInsideAndZeroOutsideAConcaveMesh) {
  const TestMesh l = make_l(2);
  EXPECT_NEAR(winding_number(l, {-0.5, 0.5, 0}), 1, 1e-12);
  EXPECT_NEAR(winding_number(l, {0.5, 0.5, 0}), 0, 1e-12);  // in the missing quarter
  EXPECT_NEAR(winding_number(inverted(l), {-0.5, 0.5, 0}), -1, 1e-12);
}

TEST(Containment, IsSeenWhicheverMeshIsInside) {
  const TestMesh small = make_cube(1), large = make_icosphere(2, 2);
  const TestPose far = at(1e6, 0, 0);
  EXPECT_TRUE(one_contains_the_other(small, far, large, far));
  EXPECT_TRUE(one_contains_the_other(large, far, small, far));
  EXPECT_FALSE(one_contains_the_other(small, at(5, 0, 0), large, at(0, 0, 0)));
}

TEST(CcdOracle, PushesTheFirstBoxOutTheShortestWay) {
  const TestMesh cube = make_cube(2);
  const auto out = convex_penetration(cube, at(0.2, 0.1, 1.9), cube, at(0, 0, 0));
  ASSERT_TRUE(out.overlap);
  EXPECT_NEAR(out.depth, 0.1, 1e-5);
  EXPECT_LT(distance(out.direction, {0, 0, 1}), 1e-4);
}

TEST(CcdOracle, FindsTheAxisOfCrossedRods) {
  const TestMesh rod = make_rod(4, 0.5);
  const TestPose lower = turned({1, 0, 0}, std::numbers::pi / 4);
  TestPose upper = composed(turned({0, 0, 1}, std::numbers::pi / 2), lower);
  upper.position = {0, 0, 0.5 * std::sqrt(2.0) - 0.05};
  const auto out = convex_penetration(rod, upper, rod, lower);
  ASSERT_TRUE(out.overlap);
  EXPECT_NEAR(out.depth, 0.05, 1e-5);
  EXPECT_LT(distance(out.direction, {0, 0, 1}), 1e-3);
}

TEST(CcdOracle, SeesNoOverlapApart) {
  const TestMesh cube = make_cube(2);
  EXPECT_FALSE(convex_penetration(cube, at(0, 0, 2.01), cube, at(0, 0, 0)).overlap);
}

}  // namespace
}  // namespace ode_ext::test
