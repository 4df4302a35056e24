// SPDX-License-Identifier: BSD-3-Clause
// The modes of a collider, from a program's side.
#include <functional>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

struct Mode {
  const char* name;
  const char* config;
};

const Mode kSameBytes[] = {
    {"IterativeRays", "rays=iterative"},
    {"Monolithic", "organization=monolithic"},
    {"MonolithicIterativeRays", "organization=monolithic,rays=iterative"},
    {"BasicDeformables", "deformable_target=basic"},
    {"ExactWorkload", "workload=exact"},
    {"PlainPrediction", "prediction=plain"},
    {"NoWalk", "rays=iterative,walk_limit=1,displacement_limit=100"},
    {"HardlyEverIterative", "rays=iterative,displacement_limit=1e-6"},
    {"CountedWork", "count_work=on"},
};

class MovingPile {
 protected:
  // Everything moves by a hair, every other body the other way: all pairs are computed again, and
  // iterative rays may be used.
  void nudge() {
    dReal by = 1e-4;
    for (const dGeomID geom : pile.geoms) {
      const dReal* p = dGeomGetPosition(geom);
      dGeomSetPosition(geom, p[0] + by, p[1], p[2]);
      by = -by;
    }
  }

  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Hash);
  Pile pile{world, space, 12, 1};
};

class ApiModes : public MovingPile, public ::testing::TestWithParam<Mode> {};

// Each pass computes all pairs: three arrangements, and two small motions after each.
TEST_P(ApiModes, GiveTheBytesOfTheDefaults) {
  const BatchCollider defaults, collider(with(GetParam().config));
  for (std::uint64_t pass = 0; pass < 9; ++pass) {
    if (pass % 3 == 0)
      pile.shake(pass + 2);
    else
      nudge();
    const auto expected = answers_of(defaults.pass(space));
    EXPECT_EQ(difference(answers_of(collider.pass(space)), expected), "") << pass;
    EXPECT_GT(collider.stats().pairs_computed, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ApiModes, ::testing::ValuesIn(kSameBytes),
                         [](const auto& mode) { return std::string(mode.param.name); });

class ApiMode : public MovingPile, public ::testing::Test {};

TEST_F(ApiMode, IterativeRaysAreUsedWhereTheyAreAskedFor) {
  const BatchCollider collider(with("rays=iterative")), full;
  for (const BatchCollider* each : {&collider, &full}) each->pass(space);
  EXPECT_GT(collider.stats().temporal_pairs, 0);
  nudge();
  for (const BatchCollider* each : {&collider, &full}) each->pass(space);
  EXPECT_GT(collider.stats().actual[dBatchBufferRaysIterative], 0);
  EXPECT_GT(collider.stats().actual[dBatchBufferChunksSmall], 0);
  EXPECT_EQ(full.stats().actual[dBatchBufferRaysIterative], 0);
  EXPECT_EQ(full.stats().temporal_pairs, 0);
}

TEST_F(ApiMode, ThePapersIterativeRaysDropVerticesAndSayHowMany) {
  const BatchCollider paper(with("rays=iterative-paper"));
  paper.pass(space);
  EXPECT_EQ(paper.stats().dropped, 0);
  long long dropped = 0;
  for (int i = 0; i < 50; ++i) {  // until new vertices have come inside
    nudge();
    paper.pass(space);
    dropped += paper.stats().dropped;
  }
  EXPECT_GT(dropped, 0);
}

TEST_F(ApiMode, CountedWorkIsReportedPerKernel) {
  // Every vertex is looked at.
  const BatchCollider counting(with("count_work=on,edges=off"));
  const BatchCollider plain(with("edges=off"));
  counting.pass(space);
  plain.pass(space);
  for (const int stage : {dBatchStageVertexStep, dBatchStageBvhRays}) {
    const auto work = [&](int quantity) {
      return dBatchColliderGetWork(counting, stage, quantity);
    };
    EXPECT_GT(work(dBatchWorkItems), 0);
    EXPECT_GT(work(dBatchWorkUnits), 0);
    EXPECT_GE(work(dBatchWorkLockstep32), work(dBatchWorkUnits));
    EXPECT_GE(work(dBatchWorkLockstep64), work(dBatchWorkLockstep32));
    EXPECT_EQ(dBatchColliderGetWork(plain, stage, dBatchWorkItems), 0);
  }
  EXPECT_EQ(dBatchColliderGetWork(counting, dBatchStageBvhRays, dBatchWorkItems),
            counting.stats().actual[dBatchBufferRaysBvh]);
}

void count_calls(void* data, dGeomID, dGeomID) { ++*static_cast<int*>(data); }

TEST_F(ApiMode, BacktrackingDeliversNothingMakesNoCallbackAndReturnsZero) {
  const BatchCollider collider(
      with("misprediction=backtrack,prediction=plain,initial_capacity=1,confidence=1"));
  // One pair is enough to predict from; then there are many more.
  for (std::size_t i = 2; i < pile.geoms.size(); ++i) dGeomDisable(pile.geoms[i]);
  int calls = 0;
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, &calls, &count_calls), 1);
  for (const dGeomID geom : pile.geoms) dGeomEnable(geom);
  calls = 0;
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, &calls, &count_calls), 0);
  EXPECT_EQ(calls, 0);
  const auto stats = collider.stats();
  EXPECT_NE(stats.status & dBatchStatusBacktracked, 0u);
  bool short_of_room = false;
  for (const int i : buffers())
    short_of_room = short_of_room || stats.actual[i] > stats.predicted[i];
  EXPECT_TRUE(short_of_room);

  int passes = 0;
  while (dBatchColliderSpaceCollide(collider, space, &calls, &count_calls) == 0)
    ASSERT_LT(++passes, static_cast<int>(buffers().size()));
  EXPECT_GT(calls, 0);
  const BatchCollider fresh;
  EXPECT_EQ(difference(answers_of(collider.pass(space)), answers_of(fresh.pass(space))), "");
}

TEST_F(ApiMode, IgnoringMispredictionsSaysWhatWasMissed) {
  const BatchCollider collider(with("misprediction=ignore,prediction=plain,confidence=1"));
  for (std::size_t i = 3; i < pile.geoms.size(); ++i) dGeomDisable(pile.geoms[i]);
  collider.pass(space);
  EXPECT_EQ(collider.stats().missed, 0);
  for (const dGeomID geom : pile.geoms) dGeomEnable(geom);
  collider.pass(space);
  EXPECT_GT(collider.stats().missed, 0);
  EXPECT_NE(collider.stats().status & dBatchStatusMissed, 0u);
  EXPECT_EQ(collider.stats().status & dBatchStatusRedone, 0u);
}

}  // namespace
}  // namespace ode_ext::test
