// SPDX-License-Identifier: BSD-3-Clause
// dBatchColliderGetStats.
#include <cstddef>
#include <cstring>

#include "device/error.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

class ApiStats : public ::testing::Test {
 protected:
  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Simple);
  Pile pile{world, space, 8, 1};
};

// A program built against an older header has a shorter struct.
TEST_F(ApiStats, FillNoMoreThanStructSize) {
  const BatchCollider collider;
  collider.pass(space);
  alignas(dBatchColliderStats) unsigned char memory[sizeof(dBatchColliderStats)];
  std::memset(memory, 0xAB, sizeof memory);
  constexpr std::size_t older = offsetof(dBatchColliderStats, predicted);
  auto* stats = reinterpret_cast<dBatchColliderStats*>(memory);
  stats->struct_size = older;
  dBatchColliderGetStats(collider, stats);
  EXPECT_EQ(stats->struct_size, older);
  EXPECT_GT(stats->pairs, 0);
  for (std::size_t i = older; i < sizeof memory; ++i) ASSERT_EQ(memory[i], 0xAB) << i;
}

// One built against a newer header has a longer one; what this library does not know stays.
TEST_F(ApiStats, FillALongerStructAsFarAsTheyGo) {
  const BatchCollider collider;
  collider.pass(space);
  struct Newer {
    dBatchColliderStats known;
    long long more;
  } newer{};
  newer.known.struct_size = sizeof newer;
  newer.more = 42;
  dBatchColliderGetStats(collider, &newer.known);
  EXPECT_GT(newer.known.pairs, 0);
  EXPECT_EQ(newer.more, 42);
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
  for (int i = 0; i < dBatchBufferCount; ++i) {
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
  for (int i = 0; i < dBatchStageCount; ++i) EXPECT_GE(stats.ms[i], 0) << i;
  for (const int i : {dBatchStageDevice, dBatchStagePass}) {
    EXPECT_GT(stats.ms[i], 0) << i;
  }
  EXPECT_GT(stats.ms[dBatchStageBvhRays] + stats.ms[dBatchStageWholeStep], 0);
  EXPECT_LE(stats.ms[dBatchStageDevice], stats.ms[dBatchStagePass]);
}

TEST_F(ApiStats, TellThatABufferWasTooSmallAndThePassRedone) {
  const BatchCollider collider([](dBatchColliderParams& p) { p.initial_capacity = 1; });
  collider.pass(space);
  const auto stats = collider.stats();
  EXPECT_NE(stats.status & dBatchStatusRedone, 0u);
  EXPECT_GE(stats.redone, 1);
  // Of the others most are of pairs that follow one another in the same room.
  EXPECT_GE(stats.capacity[dBatchBufferContacts], stats.actual[dBatchBufferContacts]);
  pile.shake(1);  // the poses it had
  collider.pass(space);
  EXPECT_EQ(collider.stats().status & dBatchStatusRedone, 0u);
}

// Exact waits for each counter before the next launch; predicted once for all of them.
TEST_F(ApiStats, CountMoreSynchronizationsForExactWorkloads) {
  const BatchCollider predicted;
  const BatchCollider exact([](dBatchColliderParams& p) { p.workload = dBatchWorkloadExact; });
  for (int i = 0; i < 3; ++i) {  // the first pass has nothing to predict from
    pile.shake(static_cast<std::uint64_t>(i) + 1);
    predicted.pass(space);
    exact.pass(space);
  }
  EXPECT_GT(exact.stats().synchronizations, predicted.stats().synchronizations);
}

TEST_F(ApiStats, PredictTheNextPassFromTheLastByEquationOne) {
  const BatchCollider collider([](dBatchColliderParams& p) { p.confidence = 1.5; });
  collider.pass(space);
  const auto first = collider.stats();
  pile.shake(2);
  collider.pass(space);
  const auto second = collider.stats();
  ASSERT_GT(first.pairs_computed, 0);
  for (int i = 0; i < dBatchBufferCount; ++i) {
    const double expected = 1.5 * static_cast<double>(first.actual[i]) *
                            static_cast<double>(second.pairs_computed) /
                            static_cast<double>(first.pairs_computed);
    EXPECT_NEAR(static_cast<double>(second.predicted[i]), expected, 1.0) << i;  // rounding up
  }
}

TEST_F(ApiStats, PredictTheNextPassFromTheLastByEquationTwo) {
  const BatchCollider collider([](dBatchColliderParams& p) {
    p.confidence = 1.5;
    p.prediction = dBatchPredictionPlain;
  });
  collider.pass(space);
  const auto first = collider.stats();
  pile.shake(2);
  collider.pass(space);
  const auto second = collider.stats();
  for (int i = 0; i < dBatchBufferCount; ++i) {
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
  for (int i = 0; i < dBatchBufferCount; ++i) {
    EXPECT_EQ(collider.stats().predicted[i], undisturbed.stats().predicted[i]) << i;
  }
}

TEST_F(ApiStats, RefuseAColliderOfZeroWithZeroes) {
  dBatchColliderStats stats;
  std::memset(&stats, 0xAB, sizeof stats);
  stats.struct_size = sizeof stats;
  dBatchColliderGetStats(nullptr, &stats);
  EXPECT_NE(last_error(), "");
  EXPECT_EQ(stats.passes, 0);
}

TEST_F(ApiStats, IgnoreNull) {
  const BatchCollider collider;
  dBatchColliderGetStats(collider, nullptr);
}

}  // namespace
}  // namespace ode_ext::test
