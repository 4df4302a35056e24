// SPDX-License-Identifier: BSD-3-Clause
// What a collider says of its last pass.
#include <set>
#include <string>

#include "opencl/error.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

class ApiStats : public ::testing::Test {
 protected:
  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Simple);
  Pile pile{world, space, 8, 1};
};

// What a program reads by value today is what it reads by that value from a later library.
TEST_F(ApiStats, HaveNamesThatAreTheirsAloneAndAscendingValues) {
  std::set<std::string> names;
  int last = -1;
  for (const int stage : stages()) {
    EXPECT_GT(stage, last);
    last = stage;
    EXPECT_TRUE(names.insert(dBatchStageName(stage)).second) << stage;
  }
  EXPECT_EQ(names.size(), 19u);
  EXPECT_EQ(stages().front(), dBatchStageGather);
  EXPECT_EQ(stages().back(), dBatchStagePass);
  names.clear();
  last = -1;
  for (int counter = dBatchCounterNext(-1); counter >= 0; counter = dBatchCounterNext(counter)) {
    EXPECT_GT(counter, last);
    last = counter;
    EXPECT_TRUE(names.insert(dBatchCounterName(counter)).second) << counter;
  }
  EXPECT_EQ(names.size(), 15u + 3 * 12);
  EXPECT_STREQ(dBatchStageName(dBatchStageWholeStep), "whole_step");
  EXPECT_STREQ(dBatchCounterName(dBatchBufferHits + dBatchPredicted), "predicted_hits");
}

TEST_F(ApiStats, RefuseAValueThatNamesNothing) {
  const BatchCollider collider;
  EXPECT_EQ(dBatchColliderGetTime(collider, 11), -1);
  EXPECT_NE(last_error().find("no stage 11"), std::string::npos) << last_error();
  EXPECT_EQ(dBatchColliderGetCount(collider, -1), -1);
  EXPECT_NE(last_error().find("no counter -1"), std::string::npos) << last_error();
  EXPECT_EQ(dBatchColliderGetWork(collider, dBatchStageCull, dBatchWorkItems), -1);
  EXPECT_NE(last_error().find("not counted of stage 100"), std::string::npos) << last_error();
  EXPECT_EQ(dBatchColliderGetWork(collider, dBatchStageBvhRays, 4), -1);
  EXPECT_NE(last_error().find("quantity is 4"), std::string::npos) << last_error();
  EXPECT_EQ(dBatchStageName(11), nullptr);
  EXPECT_EQ(dBatchCounterName(19), nullptr);
  EXPECT_EQ(dBatchStageNext(dBatchStagePass), -1);
}

TEST_F(ApiStats, CountPassesAndBuffers) {
  const BatchCollider collider;
  collider.pass(space);
  pile.shake(2);
  const Collected collected = collider.pass(space);
  const auto stats = collider.stats();
  EXPECT_EQ(stats.passes, 2);
  EXPECT_EQ(stats.meshes, 4);
  EXPECT_GT(stats.pairs_bounded, 0);
  EXPECT_LE(stats.pairs_bounded, stats.pairs_computed);
  EXPECT_LE(stats.pairs_colliding, stats.pairs_bounded);
  for (const int i : buffers()) {
    EXPECT_GE(stats.capacity[i], stats.actual[i]) << i;
  }
  EXPECT_GT(stats.actual[dBatchBufferMeshlets], 0);
  EXPECT_GT(stats.actual[dBatchBufferCrossings], 0);
  EXPECT_GT(stats.actual[dBatchBufferFloodWords], 0);
  EXPECT_GT(stats.actual[dBatchBufferRaysBvh], 0);
  EXPECT_GT(stats.actual[dBatchBufferHits], 0);
  EXPECT_GE(stats.actual[dBatchBufferContacts], collected.total());
  EXPECT_EQ(stats.pairs_stock, 0);
}

// A batch within the callback is a part of the pass: what befell the pass is not forgotten over it.
TEST_F(ApiStats, OfAPassThatFailedSaySoAfterABatchInItsCallback) {
  const BatchCollider collider;
  struct Asking {
    dBatchColliderID collider;
    static void ask(void* self, dGeomID o1, dGeomID o2) {
      const dGeomID pair[] = {o1, o2};
      dContactGeom contact;
      EXPECT_GE(dBatchColliderCollidePairs(static_cast<Asking*>(self)->collider, pair, 1, 1,
                                           &contact, sizeof contact, nullptr),
                0);
    }
  } asking{collider};
  fault_injector::arm(1, CL_DEVICE_NOT_AVAILABLE);
  dBatchColliderSpaceCollide(collider, space, &asking, &Asking::ask);
  fault_injector::disarm();
  EXPECT_NE(collider.stats().status & dBatchStatusDeviceFailed, 0u);
  collider.pass(space);
  EXPECT_EQ(collider.stats().status & dBatchStatusDeviceFailed, 0u);
}

TEST_F(ApiStats, TimeTheStages) {
  const BatchCollider collider;
  collider.pass(space);
  const auto stats = collider.stats();
  for (const int i : stages()) EXPECT_GE(stats.ms[i], 0) << i;
  for (const int i : {dBatchStageDevice, dBatchStagePass}) {
    EXPECT_GT(stats.ms[i], 0) << i;
  }
  EXPECT_GT(stats.ms[dBatchStageBvhRays] + stats.ms[dBatchStageWholeStep], 0);
  EXPECT_LE(stats.ms[dBatchStageDevice], stats.ms[dBatchStagePass]);
}

TEST_F(ApiStats, TellThatABufferWasTooSmallAndThePassRedone) {
  const BatchCollider collider(with("initial_capacity=1"));
  collider.pass(space);
  const auto stats = collider.stats();
  EXPECT_NE(stats.status & dBatchStatusRedone, 0u);
  EXPECT_GE(stats.redone, 1);
  // Of the others most are of pairs that follow one another in the same room.
  EXPECT_GE(stats.capacity[dBatchBufferContacts], stats.actual[dBatchBufferContacts]);
  for (const dGeomID geom : pile.geoms) {  // by a hair: all is computed, and finds as much
    const dReal* p = dGeomGetPosition(geom);
    dGeomSetPosition(geom, p[0] + 1e-6, p[1], p[2]);
  }
  collider.pass(space);
  EXPECT_GT(collider.stats().pairs_computed, 0);
  EXPECT_EQ(collider.stats().status & dBatchStatusRedone, 0u);
}

// Exact waits for each counter before the next launch; predicted once for all of them.
TEST_F(ApiStats, CountMoreSynchronizationsForExactWorkloads) {
  const BatchCollider predicted;
  const BatchCollider exact(with("workload=exact"));
  for (int i = 0; i < 3; ++i) {  // the first pass has nothing to predict from
    pile.shake(static_cast<std::uint64_t>(i) + 1);
    predicted.pass(space);
    exact.pass(space);
  }
  EXPECT_GT(exact.stats().synchronizations, predicted.stats().synchronizations);
}

TEST_F(ApiStats, PredictTheNextPassFromTheLastByEquationOne) {
  const BatchCollider collider(with("confidence=1.5"));
  collider.pass(space);
  const auto first = collider.stats();
  pile.shake(2);
  collider.pass(space);
  const auto second = collider.stats();
  ASSERT_GT(first.pairs_computed, 0);
  for (const int i : buffers()) {
    const double expected = 1.5 * static_cast<double>(first.actual[i]) *
                            static_cast<double>(second.pairs_computed) /
                            static_cast<double>(first.pairs_computed);
    EXPECT_NEAR(static_cast<double>(second.predicted[i]), expected, 1.0) << i;  // rounding up
  }
}

TEST_F(ApiStats, PredictTheNextPassFromTheLastByEquationTwo) {
  const BatchCollider collider(with("confidence=1.5,prediction=plain"));
  collider.pass(space);
  const auto first = collider.stats();
  pile.shake(2);
  collider.pass(space);
  const auto second = collider.stats();
  for (const int i : buffers()) {
    EXPECT_NEAR(static_cast<double>(second.predicted[i]),
                1.5 * static_cast<double>(first.actual[i]), 1.0)
        << i;
  }
}

TEST_F(ApiStats, KeepTheHistoryApartFromSinglePairs) {
  const BatchCollider collider, undisturbed;
  for (const BatchCollider* each : {&collider, &undisturbed}) each->pass(space);
  pile.shake(2);
  Contacts contacts(64);
  const dGeomID pair[] = {pile.geoms[0], pile.geoms[4]};
  ASSERT_GE(dBatchColliderCollidePairs(collider, pair, 1, 64, contacts.data(), sizeof(dContactGeom),
                                       nullptr),
            0);
  pile.shake(3);
  for (const BatchCollider* each : {&collider, &undisturbed}) each->pass(space);
  for (const int i : buffers()) {
    EXPECT_EQ(collider.stats().predicted[i], undisturbed.stats().predicted[i]) << i;
  }
}

TEST_F(ApiStats, RefuseAColliderOfZero) {
  EXPECT_EQ(dBatchColliderGetStatus(nullptr), -1);
  EXPECT_NE(last_error().find("not the handle of a live collider"), std::string::npos);
  EXPECT_EQ(dBatchColliderGetCount(nullptr, dBatchCounterPasses), -1);
  EXPECT_EQ(dBatchColliderGetTime(nullptr, dBatchStagePass), -1);
  EXPECT_EQ(dBatchColliderGetWork(nullptr, dBatchStageBvhRays, dBatchWorkItems), -1);
  EXPECT_EQ(dBatchColliderGetDeviceName(nullptr), nullptr);
}

}  // namespace
}  // namespace ode_ext::test
