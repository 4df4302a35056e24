// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/measures.h"

#include <gtest/gtest.h>

#include <limits>

namespace ode_ext::accuracy {
namespace {

TEST(Measures, TellSmallAnglesAndStraightOnes) {
  EXPECT_NEAR(degrees_between({1, 0, 0}, {1, 1e-10, 0}), 1e-10 * 180 / std::numbers::pi, 1e-15);
  EXPECT_DOUBLE_EQ(degrees_between({0, 0, 2}, {0, 3, 0}), 90);
  EXPECT_DOUBLE_EQ(degrees_between({0, 0, 1}, {0, 0, -1}), 180);
}

TEST(Measures, LetNothingHideBehindNotANumber) {
  EXPECT_TRUE(exceeds(std::numeric_limits<double>::quiet_NaN(), 1));
  EXPECT_TRUE(exceeds(1.1, 1));
  EXPECT_FALSE(exceeds(1, 1));
}

TEST(Measures, GiveTheNearestRankForAPercentile) {
  std::vector<double> values;
  for (int i = 200; i >= 1; --i) values.push_back(i);
  EXPECT_EQ(percentile(values, 99), 198);
  EXPECT_EQ(percentile(values, 0), 1);
  EXPECT_EQ(worst(values), 200);
  EXPECT_EQ(mean(values), 100.5);
  EXPECT_EQ(percentile({}, 99), 0);
}

TEST(Measures, CountShares) {
  Share share;
  EXPECT_EQ(share.percent(), 0);
  for (const bool hit : {true, false, false, false}) share.count(hit);
  EXPECT_EQ(share.percent(), 25);
}

}  // namespace
}  // namespace ode_ext::accuracy
