// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/contestant.h"

#include <gtest/gtest.h>

namespace ode_ext::accuracy {
namespace {

class Contestants : public testing::Test {
 protected:
  std::vector<test::GeomPair> towers(int count) {
    std::vector<test::GeomPair> pairs;
    for (int i = 0; i < count; ++i) {
      pairs.emplace_back(world_.geom(cube_, test::at(0.1, 0.2, 0.9 + 1e-4 * i)),
                         world_.geom(cube_, {}));
    }
    return pairs;
  }

  test::OdeWorld world_;
  const test::OdeMesh& cube_ = world_.mesh(test::make_cube(1, 2));
};

TEST_F(Contestants, GiveEachPairItsOwnContactsAlsoOverSeveralBatches) {
  const auto pairs = towers(600);
  StockOde stock;
  const auto of_stock = stock.collide(pairs);
  BatchOde batch;
  const auto of_batch = batch.collide(pairs);
  ASSERT_EQ(of_stock.size(), pairs.size());
  ASSERT_EQ(of_batch.size(), pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    ASSERT_FALSE(of_batch[i].empty()) << i;
    ASSERT_FALSE(of_stock[i].empty()) << i;
    EXPECT_EQ(of_batch[i][0].g1, pairs[i].first);
    EXPECT_LE(of_batch[i].size(), batch.limit());
    // The deepest corner, so that each pair's answer is told from its neighbours'.
    EXPECT_NEAR(deepest_of(of_batch[i])->depth, 0.1 - 1e-4 * static_cast<double>(i), 1e-5) << i;
  }
}

TEST_F(Contestants, OutliveAnAssertionThatStockOdeFails) {
  std::vector<test::GeomPair> pairs = towers(1);
  pairs.insert(pairs.begin(), {pairs[0].first, nullptr});  // no geom: an assertion of dCollide's
  StockOde stock;
  const auto answers = stock.collide(pairs);
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_TRUE(answers[0].empty());
  EXPECT_FALSE(answers[1].empty());
  EXPECT_EQ(stock.pairs_given_up(), 1);
}

TEST_F(Contestants, SayWhichContactIsTheDeepest) {
  test::Contacts contacts(3);
  EXPECT_EQ(deepest_of({}), nullptr);
  contacts[0].depth = 0;
  contacts[1].depth = 2;
  contacts[2].depth = 1;
  EXPECT_EQ(deepest_of(contacts), &contacts[1]);
}

}  // namespace
}  // namespace ode_ext::accuracy
