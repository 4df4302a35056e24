// SPDX-License-Identifier: BSD-3-Clause
// dCollide(mesh, mesh, ...) while a collider is alive: what it answers and what it writes.
#include <algorithm>
#include <cstring>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

class ApiAnswers : public ::testing::Test {
 protected:
  // A geom pair of the pile with several contacts.
  GeomPair rich_pair(const Collected& collected) {
    GeomPair best{};
    std::size_t most = 0;
    for (const auto& [pair, contacts] : collected.contacts) {
      if (contacts.size() > most) most = contacts.size(), best = pair;
    }
    EXPECT_GE(most, 4u);
    return best;
  }

  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Hash);
  Pile pile{world, space, 8, 1};
  BatchCollider collider;
};

TEST_F(ApiAnswers, InTheCallbackAreContacts) {
  const Collected collected = collider.pass(space);
  EXPECT_GT(collected.total(), 0);
  for (const auto& [pair, contacts] : collected.contacts) {
    for (const dContactGeom& c : contacts) {
      EXPECT_EQ(c.g1, pair.first);
      EXPECT_EQ(c.g2, pair.second);
      EXPECT_GT(c.depth, 0);
      EXPECT_NEAR(length(normal(c)), 1, 1e-6);  // dContactGeom's promise, ODE's own bound
      EXPECT_GE(c.side1, 0);
      EXPECT_LT(c.side1, dGeomTriMeshGetTriangleCount(c.g1));
      EXPECT_GE(c.side2, 0);
      EXPECT_LT(c.side2, dGeomTriMeshGetTriangleCount(c.g2));
    }
  }
}

TEST_F(ApiAnswers, AfterThePassAreThoseOfTheCallback) {
  const Collected collected = collider.pass(space);
  for (const auto& [pair, contacts] : collected.contacts) {
    EXPECT_EQ(difference_with_geoms(collide(pair.first, pair.second), contacts), "");
  }
  EXPECT_EQ(collider.stats().pairs_alone, 0);
}

TEST_F(ApiAnswers, InTheOtherOrderAreFlippedExactly) {
  const Collected collected = collider.pass(space);
  for (const auto& [pair, contacts] : collected.contacts) {
    EXPECT_EQ(difference_with_geoms(collide(pair.second, pair.first), flipped(contacts)), "");
  }
}

TEST_F(ApiAnswers, ToASecondQuestionAreTheSame) {
  const auto [g1, g2] = rich_pair(collider.pass(space));
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), collide(g1, g2)), "");
}

TEST_F(ApiAnswers, WithASmallerLimitAreAPrefix) {
  const auto [g1, g2] = rich_pair(collider.pass(space));
  const Contacts all = collide(g1, g2);
  for (std::size_t limit = 1; limit <= all.size() + 1; ++limit) {
    Contacts expected(all.begin(), all.begin() + static_cast<long>(std::min(limit, all.size())));
    EXPECT_EQ(difference_with_geoms(collide(g1, g2, static_cast<int>(limit)), expected), "");
    EXPECT_EQ(difference_with_geoms(collide(g2, g1, static_cast<int>(limit)), flipped(expected)),
              "");
  }
}

TEST_F(ApiAnswers, BeginWithTheDeepest) {
  for (const auto& [pair, contacts] : collider.pass(space).contacts) {
    for (const dContactGeom& c : contacts) EXPECT_LE(c.depth, contacts.front().depth);
  }
}

TEST_F(ApiAnswers, ToAFlagOfUnimportantContactsAreSomeOfThem) {
  const auto [g1, g2] = rich_pair(collider.pass(space));
  const Contacts all = collide(g1, g2);
  Contacts few(2);
  const int flags = static_cast<int>(CONTACTS_UNIMPORTANT) | 2;
  ASSERT_EQ(dCollide(g1, g2, flags, few.data(), sizeof(dContactGeom)), 2);
  for (const dContactGeom& c : few) {
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const dContactGeom& other) {
      return difference_with_geoms(Contacts{c}, Contacts{other}).empty();
    }));
  }
}

// A program's dContact has its surface parameters filled in before dCollide writes `geom`.
TEST_F(ApiAnswers, LeaveTheGapsOfALargerStrideAlone) {
  const auto [g1, g2] = rich_pair(collider.pass(space));
  const Contacts packed = collide(g1, g2, 8);
  std::vector<dContact> contacts(8);
  std::memset(static_cast<void*>(contacts.data()), 0xAB, contacts.size() * sizeof(dContact));
  const auto untouched = contacts;
  const int count = dCollide(g1, g2, 8, &contacts[0].geom, sizeof(dContact));
  ASSERT_EQ(static_cast<std::size_t>(count), packed.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    EXPECT_EQ(std::memcmp(&contacts[i].surface, &untouched[i].surface, sizeof(dSurfaceParameters)),
              0);
    EXPECT_EQ(std::memcmp(contacts[i].fdir1, untouched[i].fdir1, sizeof(dVector3)), 0);
    if (i < packed.size()) {
      EXPECT_EQ(difference_with_geoms(Contacts{contacts[i].geom}, Contacts{packed[i]}), "");
    }
  }
}

TEST_F(ApiAnswers, WriteNothingBeyondTheReturnedCount) {
  const auto [g1, g2] = rich_pair(collider.pass(space));
  Contacts contacts(65);
  std::memset(static_cast<void*>(contacts.data()), 0xAB, contacts.size() * sizeof(dContactGeom));
  const Contacts untouched = contacts;
  const auto count =
      static_cast<std::size_t>(dCollide(g1, g2, 64, contacts.data(), sizeof(dContactGeom)));
  ASSERT_GT(count, 0u);
  EXPECT_EQ(std::memcmp(&contacts[count], &untouched[count],
                        (contacts.size() - count) * sizeof(dContactGeom)),
            0);
}

TEST_F(ApiAnswers, OfNoContactsLeaveTheArrayAlone) {
  const OdeMesh& cube = world.mesh(make_cube(1));
  const dGeomID g1 = world.geom(cube, at(20, 0, 0)), g2 = world.geom(cube, at(30, 0, 0));
  Contacts contacts(4);
  std::memset(static_cast<void*>(contacts.data()), 0xAB, contacts.size() * sizeof(dContactGeom));
  const Contacts untouched = contacts;
  EXPECT_EQ(dCollide(g1, g2, 4, contacts.data(), sizeof(dContactGeom)), 0);
  EXPECT_EQ(std::memcmp(contacts.data(), untouched.data(), 4 * sizeof(dContactGeom)), 0);
}

TEST_F(ApiAnswers, ToAPairThatWasNotGatheredAreTheSameBytes) {
  const Collected gathered = collider.pass(space);
  collider.destroy();
  const BatchCollider other;
  for (const auto& [pair, contacts] : gathered.contacts) {
    EXPECT_EQ(difference_with_geoms(collide(pair.first, pair.second), contacts), "");
  }
  EXPECT_EQ(other.stats().pairs_alone, static_cast<long long>(gathered.contacts.size()));
  EXPECT_EQ(other.stats().passes, 0);
}

TEST_F(ApiAnswers, ToAPairThatWasNotGatheredAskedBackwardsAreTheSameBytes) {
  const Collected gathered = collider.pass(space);
  collider.destroy();
  const BatchCollider other;
  for (const auto& [pair, contacts] : gathered.contacts) {
    EXPECT_EQ(difference_with_geoms(collide(pair.second, pair.first), flipped(contacts)), "");
  }
}

TEST_F(ApiAnswers, AfterAPoseMovedAreThoseOfTheNewPose) {
  const auto [g1, g2] = rich_pair(collider.pass(space));
  const Contacts before = collide(g1, g2);
  const dReal* p = dGeomGetPosition(g1);
  dGeomSetPosition(g1, p[0] + 0.0625, p[1], p[2]);
  const Contacts after = collide(g1, g2);
  EXPECT_NE(difference(after, before), "");
  EXPECT_EQ(difference_with_geoms(after, fresh_answer(g1, g2)), "");
}

TEST_F(ApiAnswers, AfterARotationAreThoseOfTheNewPose) {
  const auto [g1, g2] = rich_pair(collider.pass(space));
  const Contacts before = collide(g1, g2);
  set_pose(g2, composed(pose_of(g2), turned({1, 2, 3}, 0.1)));
  const Contacts after = collide(g2, g1);
  EXPECT_NE(difference(after, flipped(before)), "");
  EXPECT_EQ(difference_with_geoms(after, fresh_answer(g2, g1)), "");
}

TEST_F(ApiAnswers, AfterMovingThereAndBackAreTheOldOnes) {
  const auto [g1, g2] = rich_pair(collider.pass(space));
  const Contacts before = collide(g1, g2);
  const TestPose pose = pose_of(g1);
  set_pose(g1, at(50, 0, 0));
  EXPECT_TRUE(collide(g1, g2).empty());
  set_pose(g1, pose);
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), before), "");
}

TEST_F(ApiAnswers, OfOtherPairsStayWhereAGeomIsMovedThereAndBack) {
  const Collected collected = collider.pass(space);
  const auto [g1, g2] = rich_pair(collected);
  const TestPose pose = pose_of(g1);
  set_pose(g1, at(50, 0, 0));
  EXPECT_TRUE(collide(g1, g2).empty());
  set_pose(g1, pose);
  ASSERT_EQ(collider.stats().pairs_alone, 1);
  std::size_t others = 0;
  for (const auto& [pair, contacts] : collected.contacts) {
    if (pair == GeomPair{g1, g2} || (pair.first != g1 && pair.second != g1)) continue;
    EXPECT_EQ(difference_with_geoms(collide(pair.first, pair.second), contacts), "");
    ++others;
  }
  EXPECT_GT(others, 1u);
  EXPECT_EQ(collider.stats().pairs_alone, 1);
}

TEST_F(ApiAnswers, OfGeomsInNoPassStayWhileTheyAreAskedFor) {
  const OdeMesh& mesh = world.mesh(make_cube(1));
  const dGeomID a = world.geom(mesh, at(90, 0, 0)), b = world.geom(mesh, at(90.9, 0, 0));
  for (int i = 0; i < 30; ++i) {
    collider.pass(space);
    EXPECT_FALSE(collide(a, b).empty());
  }
  EXPECT_EQ(collider.stats().pairs_alone, 1);
}

TEST_F(ApiAnswers, OfASecondPassOverUnmovedGeomsAreReused) {
  const Collected first = collider.pass(space), second = collider.pass(space);
  EXPECT_EQ(difference_with_geoms(first, second), "");
  EXPECT_EQ(collider.stats().pairs, static_cast<long long>(first.contacts.size()));
  EXPECT_EQ(collider.stats().pairs_computed, 0);
}

TEST_F(ApiAnswers, ForAGeomAgainstItselfAreNone) {
  collider.pass(space);
  EXPECT_TRUE(collide(pile.geoms[0], pile.geoms[0]).empty());
}

}  // namespace
}  // namespace ode_ext::test
