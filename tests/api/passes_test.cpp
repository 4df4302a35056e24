// SPDX-License-Identifier: BSD-3-Clause
// What a collider learns from one pass to the next, and that it never shows in an answer.
#include <csetjmp>
#include <cstdio>
#include <cstdlib>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

constexpr int kForgottenAfter = 8;  // passes in which nobody asked

int pass_without_questions(const BatchCollider& collider, dSpaceID space) {
  Collected collected;
  return dBatchColliderSpaceCollide(collider, space, &collected, &collect_order_only);
}

class ApiPasses : public ::testing::Test {
 protected:
  void move(double x) { dGeomSetPosition(g1, x, 0.25, 0.125); }

  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Simple);
  OdeMesh& cube = world.mesh(make_cube(1, 2));
  dGeomID g1 = world.geom(cube, at(0.5, 0.25, 0.125), space), g2 = world.geom(cube, {}, space);
  BatchCollider collider;
};

TEST_F(ApiPasses, ComputeAheadOnlyPairsThatTheProgramAsksFor) {
  for (int i = 0; i < kForgottenAfter; ++i) {
    move(0.5 + 0.01 * i);
    EXPECT_EQ(pass_without_questions(collider, space), 1);
    EXPECT_EQ(collider.stats().pairs_computed, 1) << "pass " << i;
  }
  move(0.25);
  EXPECT_EQ(pass_without_questions(collider, space), 1);
  EXPECT_EQ(collider.stats().pairs_computed, 0);
}

TEST_F(ApiPasses, AnswerAPairTheyGaveUpWithTheSameBytes) {
  for (int i = 0; i < 2 * kForgottenAfter; ++i) {
    move(0.5 + 0.01 * i);
    pass_without_questions(collider, space);
  }
  const Contacts contacts = collide(g1, g2);
  ASSERT_FALSE(contacts.empty());
  EXPECT_EQ(collider.stats().pairs_alone, 1);
  EXPECT_EQ(difference_with_geoms(contacts, fresh_answer(g1, g2)), "");
}

TEST_F(ApiPasses, ComputeAheadAgainAfterTheProgramAsked) {
  for (int i = 0; i < 2 * kForgottenAfter; ++i) {
    move(0.5 + 0.01 * i);
    pass_without_questions(collider, space);
  }
  collide(g1, g2);
  move(0.75);
  pass_without_questions(collider, space);
  EXPECT_EQ(collider.stats().pairs_computed, 1);
}

TEST_F(ApiPasses, ComputeOnlyWhatMoved) {
  const dGeomID still1 = world.geom(cube, at(5, 0, 0), space);
  const dGeomID still2 = world.geom(cube, at(5.5, 0.25, 0.125), space);
  collider.pass(space);
  EXPECT_EQ(collider.stats().pairs_computed, 2);
  move(0.75);
  const Collected collected = collider.pass(space);
  EXPECT_EQ(collider.stats().pairs, 2);
  EXPECT_EQ(collider.stats().pairs_computed, 1);
  for (const auto& [pair, contacts] : collected.contacts) {
    EXPECT_FALSE(contacts.empty());
    EXPECT_EQ(difference_with_geoms(contacts, fresh_answer(pair.first, pair.second)), "");
  }
  EXPECT_EQ(collected.contacts.size(), 2u);
  (void)still1, (void)still2;
}

TEST_F(ApiPasses, CountThePairsThatCollide) {
  world.geom(cube, at(0.9, 1.2, 0.9), space);  // its box meets g1's, the cubes overlap in a corner
  const Collected collected = collider.pass(space);
  long long colliding = 0;
  for (const auto& [pair, contacts] : collected.contacts) colliding += !contacts.empty();
  EXPECT_EQ(collider.stats().pairs_colliding, colliding);
  EXPECT_GE(colliding, 1);
}

TEST_F(ApiPasses, DoNotGatherASpaceWithoutMeshPairs) {
  const dSpaceID balls = world.space(SpaceKind::Simple);
  for (int i = 0; i < 3; ++i) world.own(dCreateSphere(balls, 1));
  EXPECT_EQ(pass_without_questions(collider, balls), 1);
  EXPECT_EQ(pass_without_questions(collider, balls), 1);
  EXPECT_NE(collider.stats().status & dBatchStatusGatherSkipped, 0u);
  EXPECT_EQ(pass_without_questions(collider, space), 1);
  EXPECT_EQ(collider.stats().status & dBatchStatusGatherSkipped, 0u);
}

TEST_F(ApiPasses, AnswerAMeshPairThatAppearsInASpaceThatHadNone) {
  const dSpaceID late = world.space(SpaceKind::Simple);
  const dGeomID ball = world.own(dCreateSphere(late, 1));
  for (int i = 0; i < 3; ++i) pass_without_questions(collider, late);
  const dGeomID m1 = world.geom(cube, at(0.5, 0.25, 0.125), late);
  const dGeomID m2 = world.geom(cube, {}, late);
  Collected first = collider.pass(late);
  const GeomPair pair = first.contacts.contains({m1, m2}) ? GeomPair{m1, m2} : GeomPair{m2, m1};
  ASSERT_TRUE(first.contacts.contains(pair));
  EXPECT_FALSE(first.contacts[pair].empty());
  EXPECT_EQ(difference_with_geoms(first.contacts[pair], fresh_answer(pair.first, pair.second)), "");
  collider.pass(late);
  EXPECT_EQ(collider.stats().status & dBatchStatusGatherSkipped, 0u);
  (void)ball;
}

TEST_F(ApiPasses, OverOneSpaceDoNotDisturbThoseOverAnother) {
  const dSpaceID other = world.space(SpaceKind::Hash);
  Pile pile(world, other, 6, 5, {20, 0, 0});
  const Collected expected = collider.pass(other);
  for (int i = 0; i < 3; ++i) {
    move(0.5 + 0.01 * i);
    collider.pass(space);
    EXPECT_EQ(difference_with_geoms(collider.pass(other), expected), "");
  }
}

// A geom that is gone may not be looked at, and one at the same address is another geom.
TEST_F(ApiPasses, SurviveGeomsDestroyedBetweenThem) {
  for (int i = 0; i < 10; ++i) {
    collider.pass(space);
    world.destroy(g1);
    g1 = world.geom(cube, at(0.5 + 0.03 * i, 0.25, 0.125), space);
    const Collected collected = collider.pass(space);
    ASSERT_EQ(collected.contacts.size(), 1u);
    const auto& [pair, contacts] = *collected.contacts.begin();
    EXPECT_FALSE(contacts.empty());
    EXPECT_EQ(difference_with_geoms(contacts, fresh_answer(pair.first, pair.second)), "");
  }
  world.destroy(g1);
  EXPECT_TRUE(collider.pass(space).order.empty());
}

// The same addresses and poses, but another mesh.
TEST_F(ApiPasses, SurviveAGeomGivenAnotherMesh) {
  collider.pass(space);
  const Contacts before = collide(g1, g2);
  set_mesh(g1, world.mesh(make_icosphere(0.5, 2)).id());
  collider.pass(space);
  const Contacts after = collide(g1, g2);
  EXPECT_NE(difference(after, before), "");
  EXPECT_EQ(difference_with_geoms(after, fresh_answer(g1, g2)), "");
}

// One of the two is behind the other in its space, which ODE takes for one that has not moved.
TEST_F(ApiPasses, SurviveGeomsGivenAnotherMeshThatThenMove) {
  const dTriMeshDataID ball = world.mesh(make_icosphere(0.5, 2)).id();
  for (const dGeomID geom : {g1, g2}) {
    collider.pass(space);
    set_mesh(geom, ball);
    TestPose pose = pose_of(geom);
    pose.position[1] += 0.01;
    set_pose(geom, pose);
    const Collected collected = collider.pass(space);
    ASSERT_EQ(collected.contacts.size(), 1u);
    const auto& [pair, contacts] = *collected.contacts.begin();
    EXPECT_FALSE(contacts.empty());
    EXPECT_EQ(difference_with_geoms(contacts, fresh_answer(pair.first, pair.second)), "");
  }
}

TEST_F(ApiPasses, SeeAGeomGivenAnotherMeshWithoutAPass) {
  collider.pass(space);
  set_mesh(g1, world.mesh(make_icosphere(0.5, 2)).id());
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), fresh_answer(g1, g2)), "");
}

// Bindings of scripting languages leave callbacks by longjmp, and ODE's own pass with them: its
// space stays locked, so that its geoms can never go. Hence a process of its own for each.
class ApiLongjmpDeathTest : public ::testing::Test {
 protected:
  ApiLongjmpDeathTest() { ::testing::FLAGS_gtest_death_test_style = "threadsafe"; }

  struct Leave {
    std::jmp_buf back;
    static void callback(void* self, dGeomID, dGeomID) {
      std::longjmp(static_cast<Leave*>(self)->back, 1);
    }
  };
  struct Scene {
    OdeWorld world;
    dSpaceID left = world.space(SpaceKind::Simple), space = world.space(SpaceKind::Simple);
    Pile in_left{world, left, 6, 3}, pile{world, space, 6, 4};
    BatchCollider collider;
  };
  // From deep down, so that later calls stand above.
  __attribute__((noinline)) static void leave(const Scene& scene, int depth = 20) {
    volatile char room[512] = {};
    if (depth > room[depth]) {
      leave(scene, depth - 1);
      return;
    }
    Leave leave;
    if (setjmp(leave.back) == 0)
      dBatchColliderSpaceCollide(scene.collider, scene.left, &leave, &Leave::callback);
  }
  static int end(bool good) {
    std::fprintf(stderr, "%s\n", good ? "good" : last_error().c_str());
    std::_Exit(good ? 0 : 1);
  }
};

TEST_F(ApiLongjmpDeathTest, OutOfACallbackLeavesAColliderThatCanBeDestroyed) {
  EXPECT_EXIT(
      {
        Scene& scene = *new Scene;
        leave(scene);
        dBatchColliderDestroy(scene.collider);
        dBatchColliderGetStatus(scene.collider);
        end(last_error().find("not the handle of a live collider") != std::string::npos);
      },
      ::testing::ExitedWithCode(0), "good");
}

TEST_F(ApiLongjmpDeathTest, OutOfACallbackLeavesAColliderThatReadsMeshesAnew) {
  EXPECT_EXIT(
      {
        Scene& scene = *new Scene;
        OdeMesh& soft = scene.world.mesh(make_icosphere(0.5, 2));
        dGeomID pair[2];
        pair[0] = scene.world.geom(soft, {});
        pair[1] = scene.world.geom(soft, at(0.9, 0, 0));
        leave(scene);
        Contacts contacts(64);
        const auto count = [&] {
          return dBatchColliderCollidePairs(scene.collider, pair, 1, 64, contacts.data(),
                                            sizeof(dContactGeom), nullptr);
        };
        const bool met = count() > 0;
        for (float& c : soft.edit().vertices) c *= 0.5f;
        end(met && count() == 0);
      },
      ::testing::ExitedWithCode(0), "good");
}

TEST_F(ApiLongjmpDeathTest, OutOfACallbackLeavesAColliderThatGoesOn) {
  EXPECT_EXIT(
      {
        Scene& scene = *new Scene;
        const Collected expected = scene.collider.pass(scene.space);
        bool good = expected.total() > 0;
        for (int i = 0; i < 3; ++i) {
          leave(scene);
          good = good && difference_with_geoms(scene.collider.pass(scene.space), expected).empty();
        }
        end(good);
      },
      ::testing::ExitedWithCode(0), "good");
}

}  // namespace
}  // namespace ode_ext::test
