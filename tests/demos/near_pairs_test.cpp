// SPDX-License-Identifier: BSD-3-Clause
#include "judging/near_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "meshes/random.h"

namespace falling_objects {
namespace {

using Pairs = std::vector<std::array<std::size_t, 2>>;

Pairs by_brute_force(const std::vector<Ball>& balls) {
  Pairs pairs;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    for (std::size_t j = i + 1; j < balls.size(); ++j) {
      const auto apart = balls[i].middle - balls[j].middle;
      const double reach = balls[i].radius + balls[j].radius;
      if (dot(apart, apart) <= reach * reach) pairs.push_back({i, j});
    }
  }
  return pairs;
}

std::vector<Ball> scattered(std::size_t count, double size, double smallest, double largest) {
  Random random(count);
  const auto somewhere = [&] { return random.between(-size, size); };
  std::vector<Ball> balls;
  for (std::size_t i = 0; i < count; ++i) {
    const double radius = smallest * std::pow(largest / smallest, random.between(0, 1));
    balls.push_back({{somewhere(), somewhere(), somewhere()}, radius});
  }
  return balls;
}

TEST(NearPairs, AreThoseOfBruteForce) {
  for (const double largest : {0.5, 1.0, 30.0}) {
    const std::vector<Ball> balls = scattered(700, 10, 0.25, largest);
    const Pairs expected = by_brute_force(balls);
    EXPECT_GT(expected.size(), 30U);
    EXPECT_EQ(near_pairs(balls), expected);
  }
}

TEST(NearPairs, AreFoundWhereBallsJustTouchAcrossCells) {
  std::vector<Ball> balls;
  for (int i = -8; i <= 8; ++i) balls.push_back({{2.0 * i, 0, 0}, 1});
  EXPECT_EQ(near_pairs(balls).size(), 16U);
  EXPECT_EQ(near_pairs(balls), by_brute_force(balls));
}

TEST(NearPairs, AreNoneOfWhatIsNowhere) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Ball> balls{
      {{nan, 0, 0}, 1}, {{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{1e300, 0, 0}, 1}};
  EXPECT_EQ(near_pairs(balls), (Pairs{{1, 2}}));
}

}  // namespace
}  // namespace falling_objects
