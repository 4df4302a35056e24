// SPDX-License-Identifier: BSD-3-Clause
#include "bench/stability/stack.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ode_ext::stability {
namespace {

std::vector<Point> places(const std::vector<TestPose>& poses) {
  std::vector<Point> result;
  for (const TestPose& pose : poses) result.push_back(pose.position);
  return result;
}

class StackTest : public ::testing::Test {
 protected:
  Random random_{1};
  std::vector<TestPose> start_ = tower(3, 0, 0, random_);
  Stack stack_{start_};
  std::vector<Point> now_ = places(start_);
};

TEST_F(StackTest, StandsWhereItStarted) {
  stack_.look(now_, 1);
  EXPECT_TRUE(stack_.stands());
  EXPECT_EQ(stack_.drift(), 0);
}

TEST_F(StackTest, FallsOnceItsTopIsATenthOfASideLower) {
  now_[2][2] -= 0.099 * kSide;
  stack_.look(now_, 1);
  EXPECT_TRUE(stack_.stands());
  now_[2][2] -= 0.002 * kSide;
  stack_.look(now_, 2);
  EXPECT_FALSE(stack_.stands());
  EXPECT_EQ(stack_.fell_at(), 2);
  stack_.look(places(start_), 3);  // for good
  EXPECT_EQ(stack_.fell_at(), 2);
}

TEST_F(StackTest, FallsOnceAnyCubeIsAQuarterOfASideToTheSide) {
  now_[0][0] += 0.2 * kSide;
  now_[0][1] -= 0.1 * kSide;
  stack_.look(now_, 1);
  EXPECT_TRUE(stack_.stands());
  EXPECT_NEAR(stack_.drift(), std::sqrt(0.05) * kSide, 1e-12);
  now_[0][1] -= 0.06 * kSide;
  stack_.look(now_, 2);
  EXPECT_FALSE(stack_.stands());
}

TEST_F(StackTest, FallsWhereAPlaceIsNotFinite) {
  now_[1][0] = NAN;
  stack_.look(now_, 1);
  EXPECT_FALSE(stack_.stands());
}

TEST(Tower, IsInLineOrOffByAsMuchAsAskedFor) {
  Random random(1);
  for (const TestPose& pose : tower(4, 0, 0, random)) {
    EXPECT_EQ(pose.position[0], 0);
    EXPECT_EQ(pose.rotation, TestPose{}.rotation);
  }
  double height = kSide / 2;
  for (const TestPose& pose : tower(10, 0.1, 0.2, random)) {
    EXPECT_LE(std::abs(pose.position[0]), 0.1 * kSide);
    EXPECT_NE(pose.position[0], 0);
    EXPECT_GE(pose.rotation[0], std::cos(0.2));
    EXPECT_NEAR(pose.position[2], height, 1e-12);
    height += kSide;
  }
}

TEST(Pyramid, RestsEveryCubeOnTwo) {
  const std::vector<TestPose> cubes = pyramid(5);
  ASSERT_EQ(cubes.size(), 15u);
  for (const TestPose& cube : cubes) {
    int below = 0;
    for (const TestPose& other : cubes) {
      const Point d = cube.position - other.position;
      const bool under = std::abs(d[2] - kSide) < 1e-9 && std::abs(d[0]) < kSide;
      below += under;
    }
    EXPECT_EQ(below, cube.position[2] < kSide ? 0 : 2);
  }
}

}  // namespace
}  // namespace ode_ext::stability
