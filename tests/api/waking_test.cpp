// SPDX-License-Identifier: BSD-3-Clause
// Pairs that the program stopped asking for (both bodies asleep) and asks for again, all in one
// pass: they are computed together, not one at a time.
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

}  // namespace
}  // namespace ode_ext::test
