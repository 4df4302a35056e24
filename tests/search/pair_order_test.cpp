// SPDX-License-Identifier: BSD-3-Clause
#include "search/pair_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "support/mesh_makers.h"

namespace ode_ext::test {
namespace {

std::vector<std::uint32_t> order_of(const std::vector<std::uint32_t>& features) {
  std::vector<std::uint32_t> order;
  put_longest_first(features, order);
  return order;
}

TEST(PairOrder, PutsPairsOfManyFeaturesBeforeThoseOfFew) {
  EXPECT_EQ(order_of({0, 5, 4000, 70, 0}), (std::vector<std::uint32_t>{2, 3, 1, 0, 4}));
}

TEST(PairOrder, LeavesPairsOfAboutAsManyFeaturesAsTheyCome) {
  EXPECT_EQ(order_of({0, 4, 7, 5, 0}), (std::vector<std::uint32_t>{1, 2, 3, 0, 4}));
}

TEST(PairOrder, IsNoneWhereAllAreAlike) {
  EXPECT_TRUE(order_of({}).empty());
  EXPECT_TRUE(order_of({0, 0, 0}).empty());
  EXPECT_TRUE(order_of({6, 4, 7}).empty());
}

TEST(PairOrder, NamesEachPairOnceAndNoneBeforeOneOfTwiceAsManyFeatures) {
  Random random(5);
  for (int run = 0; run < 100; ++run) {
    std::vector<std::uint32_t> features(static_cast<std::size_t>(1 + random.below(300)));
    for (std::uint32_t& count : features) {
      const int digits = 32 - random.below(32);
      count = static_cast<std::uint32_t>(random.next() >> (64 - digits));
    }
    features.push_back(0);
    features.push_back(0xffffffffu);
    const auto order = order_of(features);
    std::vector<std::uint32_t> sorted = order, all(features.size());
    std::sort(sorted.begin(), sorted.end());
    std::iota(all.begin(), all.end(), 0u);
    ASSERT_EQ(sorted, all);
    std::uint64_t least = 0xffffffffu;
    for (const std::uint32_t i : order) {
      EXPECT_LT(features[i], 2 * least + 1);
      least = std::min<std::uint64_t>(least, features[i]);
    }
  }
}

}  // namespace
}  // namespace ode_ext::test
