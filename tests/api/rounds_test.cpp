// SPDX-License-Identifier: BSD-3-Clause
// What is known ages by how often a program comes back to a space, however many it collides in
// turn.
#include "ode/rounds.h"

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

PassRoot ith_root(std::uintptr_t i) { return {reinterpret_cast<dGeomID>(16 * (i + 1)), nullptr}; }

TEST(Rounds, EndWhereARootComesAgain) {
  Rounds rounds;
  rounds.note_pass(ith_root(0));
  rounds.note_pass(ith_root(1));
  rounds.note_pass({ith_root(0).first, ith_root(1).first});
  const std::uint64_t first = rounds.number();
  rounds.note_pass(ith_root(1));
  EXPECT_EQ(rounds.number(), first + 1);
  rounds.note_pass(ith_root(0));
  EXPECT_EQ(rounds.number(), first + 1);
  rounds.note_pass(ith_root(0));
  EXPECT_EQ(rounds.number(), first + 2);
}

TEST(Rounds, OfOneSpaceAreItsPasses) {
  Rounds rounds;
  rounds.note_pass(ith_root(0));
  const std::uint64_t first = rounds.number();
  for (int i = 0; i < 100; ++i) rounds.note_pass(ith_root(0));
  EXPECT_EQ(rounds.number(), first + 100);
}

TEST(Rounds, EndThoughNoRootComesAgain) {
  Rounds rounds;
  const std::uint64_t first = rounds.number();
  for (std::uintptr_t i = 0; i < 10 * kPassesInARound; ++i) rounds.note_pass(ith_root(i));
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
