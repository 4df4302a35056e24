// SPDX-License-Identifier: BSD-3-Clause
// The store of answers by itself; handles are keys in it, and these are of no geoms.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include "ode/answers.h"

namespace ode_ext::test {
namespace {

dGeomID handle(std::size_t i) { return reinterpret_cast<dGeomID>(0x1000 + 64 * i); }

class KnownAnswers : public ::testing::Test {
 protected:
  Answer& entry(std::size_t i, std::uint64_t last_round) {
    Answer& answer = answers_.entry(handle(i), handle(i + 1));
    answer.last_round = last_round;
    answer.gathering = i;
    return answer;
  }
  Answer* find(std::size_t i) { return answers_.find(handle(i + 1), handle(i)); }

  Answers answers_;
};

TEST_F(KnownAnswers, AreFoundInWhateverOrderTheyAreAskedFor) {
  constexpr std::size_t kCount = 2000;
  std::vector<std::size_t> order(kCount);
  for (std::size_t i = 0; i < kCount; ++i) entry(order[i] = i, 1);
  std::mt19937 random(1);
  for (int walk = 0; walk < 6; ++walk) {
    if (walk % 2 == 0) std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t i : order) {
      if (walk == 3 && i % 3 == 0) continue;  // a program that does not ask for all
      const Answer* found = find(i);
      ASSERT_NE(found, nullptr);
      EXPECT_EQ(found->gathering, i);
    }
    EXPECT_EQ(find(kCount + 5), nullptr);
  }
}

// As where ids are asked for after contacts.
TEST_F(KnownAnswers, AreFoundTwiceInARow) {
  for (std::size_t i = 0; i < 100; ++i) entry(i, 1);
  for (int walk = 0; walk < 3; ++walk)
    for (std::size_t i = 0; i < 100; ++i)
      for (int time = 0; time < 2; ++time) {
        ASSERT_NE(find(i), nullptr);
        EXPECT_EQ(find(i)->gathering, i);
      }
}

TEST_F(KnownAnswers, ThatAreForgottenAreNotFoundAfterThoseTheyFollowed) {
  for (std::size_t i = 0; i < 4; ++i) entry(i, 100);
  for (int walk = 0; walk < 2; ++walk)
    for (std::size_t i = 0; i < 4; ++i) ASSERT_NE(find(i), nullptr);
  find(1)->last_round = 1;
  answers_.prune(100);
  EXPECT_EQ(answers_.size(), 3u);
  ASSERT_NE(find(0), nullptr);
  EXPECT_EQ(find(1), nullptr);
  EXPECT_NE(find(2), nullptr);
  // One that takes the place of what was forgotten begins empty.
  Answer& other = answers_.entry(handle(50), handle(60));
  EXPECT_EQ(other.gathering, 0u);
  EXPECT_FALSE(other.valid);
  ASSERT_NE(find(0), nullptr);
  EXPECT_EQ(find(1), nullptr);
}

TEST_F(KnownAnswers, AreTheSameWhereTheyAreMovedTogether) {
  for (std::size_t i = 0; i < 1000; ++i) entry(i, i % 100 == 0 ? 100 : 1);
  for (std::size_t i = 0; i < 1000; ++i) ASSERT_NE(find(i), nullptr);
  answers_.prune(100);
  EXPECT_EQ(answers_.size(), 10u);
  for (int walk = 0; walk < 2; ++walk)
    for (std::size_t i = 0; i < 1000; ++i) {
      const Answer* found = find(i);
      ASSERT_EQ(found != nullptr, i % 100 == 0) << i;
      if (found != nullptr) {
        EXPECT_EQ(found->gathering, i);
      }
    }
}

// In a table that is as full as it gets, where many stand behind others that wanted their place.
TEST_F(KnownAnswers, AreThoseThatWereMetOfLateWhateverIsForgottenBetween) {
  std::mt19937 random(1);
  std::map<std::size_t, std::uint64_t> expected;  // the round that each was last met in
  std::size_t forgotten = 0;
  for (std::uint64_t round = 8; round < 800; round += 8) {
    for (int i = 0; i < 40; ++i) {
      const std::size_t key = random() % 400;
      entry(key, round);
      expected[key] = round;
    }
    answers_.prune(round);
    forgotten += std::erase_if(
        expected, [&](const auto& item) { return item.second + kRoundsRemembered < round; });
    ASSERT_EQ(answers_.size(), expected.size()) << round;
    for (std::size_t i = 0; i < 400; ++i) {
      const Answer* found = find(i);
      ASSERT_EQ(found != nullptr, expected.contains(i)) << i << " in round " << round;
      if (found != nullptr) {
        EXPECT_EQ(found->last_round, expected[i]);
      }
    }
  }
  EXPECT_GT(forgotten, 2000u);
}

}  // namespace
}  // namespace ode_ext::test
