// SPDX-License-Identifier: BSD-3-Clause
// What is known ages by how often a program comes back to a space, however many it collides in
// turn.
#include "ode/rounds.h"

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

PassRoot ith_root(std::uintptr_t i) { return {reinterpret_cast<dGeomID>(16 * (i + 1)), nullptr}; }

TEST(Rounds, EndWhereARootComesAgainAndAllOthersHaveCome) {
  Rounds rounds;
  rounds.note_pass(ith_root(0), 1);
  rounds.note_pass(ith_root(1), 1);
  rounds.note_pass({ith_root(0).first, ith_root(1).first}, 1);
  const std::uint64_t first = rounds.number();
  rounds.note_pass(ith_root(1), 1);
  EXPECT_EQ(rounds.number(), first + 1);
  rounds.note_pass(ith_root(0), 1);
  rounds.note_pass(ith_root(0), 1);  // the pair of both is to come yet
  EXPECT_EQ(rounds.number(), first + 1);
  rounds.note_pass({ith_root(0).first, ith_root(1).first}, 1);
  EXPECT_EQ(rounds.number(), first + 1);
  rounds.note_pass(ith_root(0), 1);
  EXPECT_EQ(rounds.number(), first + 2);
}

// Sensors that are asked between one space and the next, each world stepped several times.
TEST(Rounds, AreAsLongAsTheLongestWayRound) {
  for (const int repeats : {1, 10}) {
    Rounds rounds;
    const auto go_round = [&] {
      for (std::uintptr_t i = 0; i < 50; ++i)
        for (int k = 0; k < repeats; ++k) {
          rounds.note_pass(ith_root(i), 1);
          rounds.note_pass(ith_root(100), 1);
        }
    };
    for (int i = 0; i < 8; ++i) go_round();  // it takes a few to find out
    const std::uint64_t before = rounds.number();
    for (int i = 0; i < 20; ++i) go_round();
    EXPECT_LE(rounds.number(), before + 20) << repeats;
    EXPECT_GE(rounds.number(), before + 15) << repeats;
  }
}

TEST(Rounds, EndThoughTheRootsOfTheLastDoNotCome) {
  Rounds rounds;
  for (std::uintptr_t i = 0; i < 100; ++i) rounds.note_pass(ith_root(i), 1);
  for (std::size_t i = 0; i < 2 * kPassesInARound; ++i) rounds.note_pass(ith_root(0), 1);
  const std::uint64_t before = rounds.number();
  for (int i = 0; i < 10; ++i) rounds.note_pass(ith_root(0), 1);
  EXPECT_EQ(rounds.number(), before + 10);
}

TEST(Rounds, BringNoMorePairsThanMemoryHasRoomFor) {
  Rounds rounds;
  const std::uint64_t first = rounds.number();
  for (std::uintptr_t i = 0; i < 100; ++i) rounds.note_pass(ith_root(i), kPairsInARound / 10);
  EXPECT_GE(rounds.number(), first + 9);
}

TEST(Rounds, OfOneSpaceAreItsPasses) {
  Rounds rounds;
  rounds.note_pass(ith_root(0), 1);
  const std::uint64_t first = rounds.number();
  for (int i = 0; i < 100; ++i) rounds.note_pass(ith_root(0), 1);
  EXPECT_EQ(rounds.number(), first + 100);
}

TEST(Rounds, EndThoughNoRootComesAgain) {
  Rounds rounds;
  const std::uint64_t first = rounds.number();
  for (std::uintptr_t i = 0; i < 10 * kPassesInARound; ++i) rounds.note_pass(ith_root(i), 1);
  EXPECT_EQ(rounds.number(), first + 9);
}

class ApiRounds : public ::testing::Test {
 protected:
  dSpaceID space_with_a_pile(std::uint64_t seed) {
    const dSpaceID space = world.space(SpaceKind::Hash);
    piles.push_back(std::make_unique<Pile>(world, space, 6, seed));
    return space;
  }

  OdeWorld world;
  std::vector<std::unique_ptr<Pile>> piles;
};

TEST_F(ApiRounds, AnswersOfSpacesThatAreCollidedInTurnStay) {
  std::vector<dSpaceID> spaces;
  for (std::uint64_t i = 0; i < 40; ++i) spaces.push_back(space_with_a_pile(i));
  const BatchCollider collider;
  long long first = 0, later = 0;
  for (const dSpaceID space : spaces) {
    collider.pass(space);
    first += collider.stats().pairs_computed;
  }
  ASSERT_GT(first, 100);
  for (int round = 0; round < 20; ++round)
    for (const dSpaceID space : spaces) {
      collider.pass(space);
      later += collider.stats().pairs_computed;
    }
  EXPECT_EQ(later, 0);
}

TEST_F(ApiRounds, AnswersOfAGeomWithEachOfManyInTurnStay) {
  const dSpaceID space = space_with_a_pile(1);
  std::vector<dGeomID> probes;
  OdeMesh& ball = world.mesh(make_icosphere(0.6, 1));
  for (int i = 0; i < 40; ++i) probes.push_back(world.geom(ball, at(0.05 * i, 0, 0)));
  const BatchCollider collider;
  const auto computed = [&] {
    long long sum = 0;
    for (const dGeomID probe : probes) {
      Collected collected;
      EXPECT_EQ(dBatchColliderSpaceCollide2(collider, probe, as_geom(space), &collected, &collect),
                1);
      sum += collider.stats().pairs_computed;
    }
    return sum;
  };
  ASSERT_GT(computed(), 40);
  for (int round = 0; round < 20; ++round) EXPECT_EQ(computed(), 0) << round;
}

}  // namespace
}  // namespace ode_ext::test
