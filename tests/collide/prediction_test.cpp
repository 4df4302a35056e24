// SPDX-License-Identifier: BSD-3-Clause
#include "collide/prediction.h"

#include <gtest/gtest.h>

namespace ode_ext {
namespace {

const History kHistory{100, {1000, 500, 70, 7, 1000, 500, 70, 7, 30, 20, 10, 10}};

TEST(Prediction, ScalesTheLastCountsWithThePairsAsInEquation1) {
  EXPECT_EQ(predict(kHistory, 200, PredictionRule::kPairScaled, 1.0),
            (ListCounts{2000, 1000, 140, 14, 2000, 1000, 140, 14, 60, 40, 20, 20}));
  EXPECT_EQ(predict(kHistory, 50, PredictionRule::kPairScaled, 1.5),
            (ListCounts{750, 375, 53, 6, 750, 375, 53, 6, 23, 15, 8,
                        8}));  // 52.5 and 5.25 ... rounded up
}

TEST(Prediction, KeepsTheLastCountsWhateverThePairsAsInEquation2) {
  EXPECT_EQ(predict(kHistory, 200, PredictionRule::kPlain, 1.0), kHistory.counts);
  EXPECT_EQ(predict(kHistory, 1, PredictionRule::kPlain, 1.5),
            (ListCounts{1500, 750, 105, 11, 1500, 750, 105, 11, 45, 30, 15, 15}));
}

TEST(Prediction, HasNoRatioAfterAPassWithoutPairs) {
  const History history{0, {8, 4, 2, 1, 8, 4, 2, 1, 8, 4, 2, 2}};
  EXPECT_EQ(predict(history, 1000, PredictionRule::kPairScaled, 2.0),
            (ListCounts{16, 8, 4, 2, 16, 8, 4, 2, 16, 8, 4, 4}));
}

TEST(Prediction, IsAtLeastOne) {
  EXPECT_EQ(predict({}, 100, PredictionRule::kPairScaled, 1.2),
            (ListCounts{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(predict(kHistory, 0, PredictionRule::kPairScaled, 1.2),
            (ListCounts{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(predict(kHistory, 100, PredictionRule::kPlain, 0.0),
            (ListCounts{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
}

TEST(Prediction, EndsAtTwoToTheFortyWhereTheNumbersLoseAllMeasure) {
  const History history{1,
                        {UINT64_MAX, std::uint64_t{1} << 39, std::uint64_t{1} << 40, 1, UINT64_MAX,
                         std::uint64_t{1} << 39, std::uint64_t{1} << 40, 1, 1, 2, 3, 3}};
  const std::uint64_t most = std::uint64_t{1} << 40;
  EXPECT_EQ(predict(history, UINT64_MAX, PredictionRule::kPairScaled, 1e300),
            (ListCounts{most, most, most, most, most, most, most, most, most, most, most, most}));
  EXPECT_EQ(predict(history, 1, PredictionRule::kPairScaled, 1.0),
            (ListCounts{most, most / 2, most, 1, most, most / 2, most, 1, 1, 2, 3, 3}));
}

}  // namespace
}  // namespace ode_ext
