// SPDX-License-Identifier: BSD-3-Clause
// Pairs that the program does not ask for: such as it stopped asking for (both bodies asleep) and
// asks for again, all in one pass, which are computed together, not one at a time; and such as it
// never asks for, of which few are computed.
#include <algorithm>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

void ask_nothing(void*, dGeomID, dGeomID) {}

class ApiWaking : public ::testing::Test {
 protected:
  void sleep(int passes) {
    for (int i = 0; i < passes; ++i)
      ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, nullptr, &ask_nothing), 1);
  }

  // So little that the pairs stay what they are, but each is to be computed anew.
  void nudge() {
    for (const dGeomID geom : pile.geoms) {
      const dReal* p = dGeomGetPosition(geom);
      dGeomSetPosition(geom, p[0] + 1e-6, p[1], p[2]);
    }
  }

  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Simple);
  Pile pile{world, space, 24, 7};
  BatchCollider collider;
};

TEST_F(ApiWaking, ComputesAllButTheFirstFewPairsInOneBatch) {
  collider.pass(space);
  sleep(12);
  nudge();
  sleep(1);
  ASSERT_EQ(collider.stats().pairs_computed, 0) << "the pile does not sleep";
  const long long alone = collider.stats().pairs_alone;
  const Collected awake = collider.pass(space);
  const auto pairs = static_cast<long long>(awake.contacts.size());
  ASSERT_GT(pairs, 50);
  EXPECT_LE(collider.stats().pairs_alone - alone, 4);
  EXPECT_GE(collider.stats().pairs_computed, pairs - 4);
  const BatchCollider fresh;
  EXPECT_EQ(difference_with_geoms(awake, fresh.pass(space)), "");
}

TEST_F(ApiWaking, ComputesNothingOfWhatHasNotMoved) {
  const Collected before = collider.pass(space);
  const long long colliding = collider.stats().pairs_colliding;
  ASSERT_GT(colliding, 0);
  sleep(30);
  EXPECT_EQ(collider.stats().pairs_colliding, colliding);
  const Collected awake = collider.pass(space);
  EXPECT_EQ(collider.stats().pairs_alone, 0);
  EXPECT_EQ(collider.stats().pairs_computed, 0);
  EXPECT_EQ(difference_with_geoms(awake, before), "");
}

// Of a pile that rests and of one that wakes.
TEST_F(ApiWaking, SaysOfAGeomAtNoPoseWhatAPassSaysThatAsks) {
  const dGeomID skewed = pile.geoms[5];
  collider.pass(space);
  sleep(12);
  dMatrix3 rotation;
  std::copy_n(dGeomGetRotation(skewed), 12, rotation);
  rotation[0] *= 2;
  dGeomSetRotation(skewed, rotation);
  nudge();
  collider.pass(space);  // its callback wakes them
  EXPECT_NE(collider.stats().status & dBatchStatusPoseRefused, 0u);
  sleep(12);
  EXPECT_EQ(collider.stats().pairs_computed, 0) << "the pile does not sleep";
  EXPECT_NE(collider.stats().status & dBatchStatusPoseRefused, 0u);
}

TEST_F(ApiWaking, SaysOfAGeomThatNobodyAsksForWhatItsPoseIsNow) {
  const dGeomID geom = pile.geoms[5];
  collider.pass(space);
  sleep(12);
  dMatrix3 upright, skewed;
  std::copy_n(dGeomGetRotation(geom), 12, upright);
  std::copy_n(upright, 12, skewed);
  skewed[0] *= 2;
  for (int i = 0; i < 2; ++i) {
    dGeomSetRotation(geom, skewed);
    sleep(1);
    EXPECT_NE(collider.stats().status & dBatchStatusPoseRefused, 0u);
    dGeomSetRotation(geom, upright);
    sleep(1);
    EXPECT_EQ(collider.stats().status & dBatchStatusPoseRefused, 0u);
  }
}

TEST_F(ApiWaking, DoesNotStallAfterTheLongestSleep) {
  collider.pass(space);
  sleep(700);  // longer than meshes that nobody meets are kept
  nudge();
  const long long alone = collider.stats().pairs_alone;
  const Collected awake = collider.pass(space);
  EXPECT_LE(collider.stats().pairs_alone - alone, 4);
  const BatchCollider fresh;
  EXPECT_EQ(difference_with_geoms(awake, fresh.pass(space)), "");
}

TEST_F(ApiWaking, SeesMeshesThatWereEditedWhileNobodyLooked) {
  OdeMesh& mesh = world.mesh(make_cube(1));
  const dGeomID cube = world.geom(mesh, {}, space);
  collider.pass(space);
  sleep(12);
  for (float& x : mesh.edit().vertices) x *= 1.25f;
  (void)cube;
  const Collected awake = collider.pass(space);
  const BatchCollider fresh;
  EXPECT_EQ(difference_with_geoms(awake, fresh.pass(space)), "");
}

// A program that asks for a pair or two of those that sleep does not pay for all of them.
TEST_F(ApiWaking, IsNotTakenForOneOfTwoOrThree) {
  collider.pass(space);
  sleep(12);
  nudge();
  struct First {
    int left = 3;
    static void ask(void* self, dGeomID o1, dGeomID o2) {
      if (static_cast<First*>(self)->left-- > 0) collide(o1, o2);
    }
  } first;
  const long long alone = collider.stats().pairs_alone;
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, &first, &First::ask), 1);
  EXPECT_EQ(collider.stats().pairs_alone - alone, 3);
  EXPECT_EQ(collider.stats().pairs_computed, 0);
}

// Objects that a program keeps in one place until it needs them: every two of them meet.
class ApiStore : public ::testing::Test {
 protected:
  static constexpr int kCount = 60, kPairs = kCount * (kCount - 1) / 2;

  ApiStore() {
    const OdeMesh& cube = world.mesh(make_cube(1));
    for (int i = 0; i < kCount; ++i) cubes.push_back(world.geom(cube, at(0.001 * i, 0, 0), space));
  }

  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Simple);
  std::vector<dGeomID> cubes;
  BatchCollider collider;
};

TEST_F(ApiStore, OfWhichNothingIsAskedIsHardlyComputed) {
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, nullptr, &ask_nothing), 1);
  EXPECT_EQ(collider.stats().pairs, kPairs);
  EXPECT_LE(collider.stats().pairs_computed, kPairs / 6);
  for (int i = 0; i < 12; ++i) {
    ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, nullptr, &ask_nothing), 1);
    EXPECT_EQ(collider.stats().pairs_computed, 0) << "pass " << i;
  }
}

TEST_F(ApiStore, OfWhichAllIsAskedIsComputedInBatches) {
  const Collected found = collider.pass(space);
  EXPECT_LE(collider.stats().pairs_alone, 4);
  EXPECT_GE(collider.stats().pairs_computed, kPairs - 4);
  std::vector<dGeomID> pairs;
  for (const auto& [pair, contacts] : found.contacts) {
    pairs.push_back(pair.first);
    pairs.push_back(pair.second);
  }
  ASSERT_EQ(pairs.size(), 2u * kPairs);
  EXPECT_EQ(collider.stats().pairs_colliding, kPairs);
  const BatchCollider fresh;
  for (std::size_t i = 0; i < pairs.size(); i += 2)
    ASSERT_EQ(difference(found.contacts.at({pairs[i], pairs[i + 1]}),
                         answer_of(fresh, pairs[i], pairs[i + 1])),
              "");
  collider.pass(space);
  EXPECT_EQ(collider.stats().pairs_computed, 0);
}

// Each object has a mesh of its own, which no pass has read before. Asked for after the pass, in
// the other order.
TEST_F(ApiStore, OfWhichAllIsAskedAfterThePassIsComputedInBatches) {
  for (std::size_t i = 0; i < cubes.size(); ++i)
    set_mesh(cubes[i], world.mesh(make_cube(1 + 0.01 * static_cast<double>(i))).id());
  Collected met;
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, &met, &collect_order_only), 1);
  ASSERT_EQ(met.order.size(), static_cast<std::size_t>(kPairs));
  std::vector<Contacts> found;
  for (auto pair = met.order.rbegin(); pair != met.order.rend(); ++pair)
    found.push_back(collide(pair->first, pair->second));
  EXPECT_LE(collider.stats().pairs_alone, 4);
  EXPECT_GE(collider.stats().pairs_computed, kPairs - 4);
  EXPECT_EQ(collider.stats().pairs_colliding, kPairs);
  const BatchCollider fresh;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& [g1, g2] = met.order[found.size() - 1 - i];
    ASSERT_EQ(difference(found[i], answer_of(fresh, g1, g2)), "") << i;
  }
}

// What it does not want it pays for twice as often as for what it wants, at most, wherever it lies.
TEST_F(ApiStore, OfWhichSomeIsAskedIsComputedByAsMuch) {
  struct EveryHundredth {
    int met = 0, asked = 0;
    static void ask(void* self, dGeomID o1, dGeomID o2) {
      auto& picker = *static_cast<EveryHundredth*>(self);
      if (++picker.met % 100 != 0) return;
      ++picker.asked;
      EXPECT_FALSE(collide(o1, o2).empty());
    }
  } picker;
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, &picker, &EveryHundredth::ask), 1);
  EXPECT_EQ(picker.asked, 17);
  EXPECT_LE(collider.stats().pairs_computed, kPairs / 3);
}

// What was noted in a pass is of no use where its objects have been moved since.
TEST_F(ApiStore, ThatIsMovedAfterAPassIsComputedAsItIsAsked) {
  Collected met;
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, &met, &collect_order_only), 1);
  const long long computed = collider.stats().pairs_computed;
  for (std::size_t i = 0; i < cubes.size(); ++i)
    dGeomSetPosition(cubes[i], 0.001 * static_cast<double>(i), 0.002 * static_cast<double>(i), 0);
  std::vector<Contacts> found;
  for (std::size_t i = 1000; i < 1100; ++i)
    found.push_back(collide(met.order[i].first, met.order[i].second));
  EXPECT_EQ(collider.stats().pairs_alone, 100);
  EXPECT_LE(collider.stats().pairs_computed - computed, 8);
  const BatchCollider fresh;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& [g1, g2] = met.order[1000 + i];
    ASSERT_EQ(difference(found[i], answer_of(fresh, g1, g2)), "") << i;
  }
}

}  // namespace
}  // namespace ode_ext::test
