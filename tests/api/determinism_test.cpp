// SPDX-License-Identifier: BSD-3-Clause
// The same poses and meshes give the same bytes, whatever else is different.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

// The contacts of two geoms that alone make a pass, seen from the first.
Contacts contacts_of(const Collected& pass, dGeomID o1, dGeomID o2) {
  if (const auto found = pass.contacts.find({o1, o2}); found != pass.contacts.end())
    return found->second;
  const auto found = pass.contacts.find({o2, o1});
  return found == pass.contacts.end() ? Contacts{} : flipped(found->second);
}

class ApiDeterminism : public ::testing::Test {
 protected:
  std::vector<Contacts> answers(const BatchCollider::Change& change = {}) {
    return answers_of(BatchCollider(change).pass(space));
  }

  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Hash);
  Pile pile{world, space, 12, 1};
};

TEST_F(ApiDeterminism, RepeatedRunsAgree) {
  const auto expected = answers();
  ASSERT_GT(expected.size(), 20u);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(difference(answers(), expected), "");
}

TEST_F(ApiDeterminism, WorkGroupSizesAgree) {
  const auto expected = answers();
  for (const int size : {1, 32, 64, 256}) {
    EXPECT_EQ(difference(answers(with("work_group_size=" + std::to_string(size))), expected), "")
        << size;
  }
}

// 0.01 launches far too few work-groups in the second pass: each must do more, none may be lost.
TEST_F(ApiDeterminism, ConfidencesAgree) {
  const auto first = answers();
  pile.shake(2);
  const auto second = answers();
  EXPECT_NE(difference(first, second), "");
  for (const double confidence : {0.01, 10.0}) {
    const BatchCollider collider(with("confidence=" + std::to_string(confidence)));
    pile.shake(1);
    EXPECT_EQ(difference(answers_of(collider.pass(space)), first), "") << confidence;
    pile.shake(2);
    EXPECT_EQ(difference(answers_of(collider.pass(space)), second), "") << confidence;
  }
}

TEST_F(ApiDeterminism, ASmallInitialCapacityLosesNothing) {
  const auto expected = answers();
  EXPECT_EQ(difference(answers(with("initial_capacity=1")), expected), "");
}

TEST_F(ApiDeterminism, ExactAndPredictedWorkloadsAgree) {
  const auto expected = answers();
  EXPECT_EQ(difference(answers(with("workload=exact")), expected), "");
}

TEST_F(ApiDeterminism, BothPredictionsAgree) {
  const auto expected = answers();
  EXPECT_EQ(difference(answers(with("prediction=plain")), expected), "");
}

TEST_F(ApiDeterminism, APairAloneAgreesWithABatch) {
  const Collected batch = BatchCollider().pass(space);
  for (const auto& [pair, contacts] : batch.contacts) {
    EXPECT_EQ(difference_with_geoms(fresh_answer(pair.first, pair.second), contacts), "");
  }
}

TEST_F(ApiDeterminism, AnswersDoNotDependOnHowThePosesWereReached) {
  const auto expected = answers();
  const BatchCollider collider;
  for (std::uint64_t seed = 2; seed < 12; ++seed) {
    pile.shake(seed);
    collider.pass(space);
  }
  pile.shake(1);
  EXPECT_EQ(difference(answers_of(collider.pass(space)), expected), "");
}

// Small motions, as in a simulation: what is kept from the last pass may not show.
TEST_F(ApiDeterminism, AnswersAfterSmallMotionsAreThoseOfAFreshCollider) {
  const BatchCollider collider;
  for (int pass = 0; pass < 5; ++pass) {
    for (const dGeomID geom : pile.geoms) {
      const TestPose pose = pose_of(geom);
      set_pose(geom, composed(pose, turned({1, 2, 3}, 0.01, {0.001, 0, -0.002})));
    }
    EXPECT_EQ(difference(answers_of(collider.pass(space)), answers()), "") << "pass " << pass;
  }
}

TEST_F(ApiDeterminism, AnswersDoNotDependOnTheOtherPairsOfTheBatch) {
  const dGeomID a = pile.geoms[0], b = pile.geoms[1];
  const Contacts among_others = contacts_of(BatchCollider().pass(space), a, b);
  ASSERT_FALSE(among_others.empty());
  for (std::size_t i = 2; i < pile.geoms.size(); ++i) dGeomDisable(pile.geoms[i]);
  const Collected alone = BatchCollider().pass(space);
  EXPECT_EQ(alone.order.size(), 1u);
  EXPECT_EQ(difference_with_geoms(contacts_of(alone, a, b), among_others), "");
}

// The order of creation decides ODE's pair order, and with it who is first in a pair.
TEST_F(ApiDeterminism, AnswersDoNotDependOnWhichGeomOdeNamesFirst) {
  const BatchCollider collider;
  for (std::size_t i = 1; i < pile.geoms.size(); ++i) {
    const Contacts forward = fresh_answer(pile.geoms[0], pile.geoms[i]);
    EXPECT_EQ(difference_with_geoms(fresh_answer(pile.geoms[i], pile.geoms[0]), flipped(forward)),
              "");
  }
}

// Other addresses of geoms and meshes may not decide anything.
TEST_F(ApiDeterminism, ASecondSceneOfTheSameMakeAgrees) {
  const auto expected = answers();
  const dSpaceID again = world.space(SpaceKind::Hash);
  Pile twin(world, again, 12, 1);
  EXPECT_EQ(difference(answers_of(BatchCollider().pass(again)), expected), "");
}

// Poses are subtracted in double. The pile's offsets are multiples of 2^-10, so adding 10^6 rounds
// nothing before the library sees them; positions are 10^6 + a double's 2^-33 there.
TEST_F(ApiDeterminism, FarFromTheOriginContactsAreTheSameToATenthOfAMillimetre) {
  const Point far{1e6, -1e6, 1e6};
  for (const char* edges : {"edges=on", "edges=off"}) {
    const BatchCollider collider(with(edges));
    for (const std::uint64_t seed : {1u, 4u, 5u, 6u}) {
      const dSpaceID there = world.space(SpaceKind::Simple);  // a hash space overflows its cells
      const dSpaceID here = world.space(SpaceKind::Simple);
      Pile twin(world, there, 12, seed, far), twin_here(world, here, 12, seed);
      const auto expected = answers_of(collider.pass(here)), got = answers_of(collider.pass(there));
      ASSERT_EQ(got.size(), expected.size());
      long long compared = 0;
      for (std::size_t i = 0; i < got.size(); ++i) {
        ASSERT_EQ(got[i].size(), expected[i].size()) << "seed " << seed << ", pair " << i;
        for (const dContactGeom& c : got[i]) {
          EXPECT_TRUE(std::any_of(expected[i].begin(), expected[i].end(),
                                  [&](const auto& other) {
                                    return distance(pos(c) - far, pos(other)) < 1e-4 &&
                                           distance(normal(c), normal(other)) < 1e-4 &&
                                           std::fabs(c.depth - other.depth) < 1e-4 &&
                                           c.side1 == other.side1 && c.side2 == other.side2;
                                  }))
              << "seed " << seed << ", pair " << i;
          ++compared;
        }
      }
      EXPECT_GT(compared, 50);
    }
  }
}

TEST_F(ApiDeterminism, FarFromTheOriginTheDeepestContactsAreAsDeepToATenthOfAMillimetre) {
  const dSpaceID there = world.space(SpaceKind::Simple), here = world.space(SpaceKind::Simple);
  Pile twin(world, there, 12, 1, {1e6, -1e6, 1e6});
  Pile twin_here(world, here, 12, 1);
  const BatchCollider collider;
  const auto expected = answers_of(collider.pass(here)), got = answers_of(collider.pass(there));
  ASSERT_EQ(got.size(), expected.size());
  int compared = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    ASSERT_EQ(got[i].empty(), expected[i].empty()) << "pair " << i;
    if (got[i].empty()) continue;
    EXPECT_NEAR(got[i][0].depth, expected[i][0].depth, 1e-4) << "pair " << i;
    ++compared;
  }
  EXPECT_GT(compared, 20);
}

// Facets of a deformable mesh are its triangles, so two of them are of one plane here and cost a
// vertex the same: which of them comes first in a list is the device's.
TEST(ApiLaunches, SoftRingsInOneAnotherAreTheSameInOneGoAndStepByStep) {
  OdeWorld world;
  const OdeMesh& ring = world.mesh(make_torus(0.5, 0.2, 12, 8));
  const OdeMesh& coarse = world.mesh(make_torus(0.5, 0.2, 6, 4));
  const dGeomID a = world.geom(ring, {}), b = world.geom(coarse, {});
  const BatchCollider in_one_go, step_by_step(with("workload=exact"));
  for (const BatchCollider* by : {&in_one_go, &step_by_step})
    for (const OdeMesh* mesh : {&ring, &coarse})
      dBatchColliderTriMeshDataSetDeformable(*by, mesh->id(), 1);
  Random random(31);
  for (int i = 0; i < 200; ++i) {
    const TestPose pose = turned({0, 1, 0}, std::numbers::pi / 2,
                                 {0.05 * random.below(9), 0.05 * random.below(9), 0});
    const Point axis = random.direction();
    set_pose(b, composed(turned(axis, random.uniform(0, 1e-4)), pose));
    EXPECT_EQ(difference(answer_of(in_one_go, a, b, 1000), answer_of(step_by_step, a, b, 1000)), "")
        << i;
  }
}

// What else a collider knows decides where the parts of a mesh are in its arrays, and nothing more.
TEST(ApiCompany, AnswersDoNotDependOnTheOtherMeshesOfTheCollider) {
  OdeWorld world;
  const dGeomID torus = world.geom(world.mesh(make_torus(0.5, 0.2, 10, 5)), {});
  const dGeomID ball = world.geom(world.mesh(make_icosphere(0.5, 1)), {});
  const OdeMesh& other = world.mesh(make_cube(1, 8));
  const dGeomID unrelated[] = {world.geom(other, {}), world.geom(other, at(0.5, 0.25, 0.125))};
  const BatchCollider alone, company;
  ASSERT_FALSE(answer_of(company, unrelated[0], unrelated[1]).empty());
  Random random(4);
  int colliding = 0;
  for (int i = 0; i < 500; ++i) {
    set_pose(torus, random.pose(0.5));
    set_pose(ball, random.pose(0.5));
    const Contacts expected = answer_of(alone, torus, ball);
    EXPECT_EQ(difference(answer_of(company, torus, ball), expected), "") << "pose " << i;
    colliding += expected.empty() ? 0 : 1;
  }
  EXPECT_GT(colliding, 300);
}

// The order in which the meshes come to be known decides the same.
TEST(ApiCompany, AnswersDoNotDependOnTheOrderInWhichGeomsWereMade) {
  OdeWorld world;
  const OdeMesh& torus = world.mesh(make_torus(0.5, 0.2, 10, 5));
  const OdeMesh& ball = world.mesh(make_icosphere(0.5, 1));
  const dSpaceID one = world.space(SpaceKind::Simple), two = world.space(SpaceKind::Simple);
  const dGeomID first[] = {world.geom(torus, {}, one), world.geom(ball, {}, one)};
  const dGeomID last_ball = world.geom(ball, {}, two);
  const dGeomID second[] = {world.geom(torus, {}, two), last_ball};
  const BatchCollider forward, backward;
  Random random(5);
  int colliding = 0;
  for (int i = 0; i < 500; ++i) {
    const TestPose poses[] = {random.pose(0.5), random.pose(0.5)};
    for (std::size_t k = 0; k < 2; ++k) {
      set_pose(first[k], poses[k]);
      set_pose(second[k], poses[k]);
    }
    const Collected a = forward.pass(one), b = backward.pass(two);
    const Contacts expected = contacts_of(a, first[0], first[1]);
    EXPECT_EQ(difference(contacts_of(b, second[0], second[1]), expected), "") << "pose " << i;
    colliding += expected.empty() ? 0 : 1;
  }
  EXPECT_GT(colliding, 300);
}

}  // namespace
}  // namespace ode_ext::test
