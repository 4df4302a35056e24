// SPDX-License-Identifier: BSD-3-Clause
#include "search/append_lists.h"

#include <gtest/gtest.h>

#include "abi/contacts.h"
#include "opencl/error.h"

namespace ode_ext {
namespace {

ListCounts all(std::uint64_t count) {
  ListCounts counts;
  counts.fill(count);
  return counts;
}

TEST(AppendLists, HaveNoRoomUntilAsked) {
  Device device("");
  const AppendLists lists(device);
  EXPECT_EQ(lists.capacities(), all(0));
  EXPECT_FALSE(lists.overflowed(all(0)));
  EXPECT_TRUE(lists.overflowed(all(1)));
}

TEST(AppendLists, GrowByAQuarterMoreThanAsked) {
  Device device("");
  AppendLists lists(device);
  lists.reserve(all(1000));
  EXPECT_EQ(lists.capacities(), all(1250));
  EXPECT_EQ(lists.task_capacity(), 3750u);
  EXPECT_GE(lists.tasks().capacity(), 3750 * sizeof(ox_chunk_task));
  EXPECT_GE(lists.rays().capacity(), 3750 * sizeof(ox_ray));
  EXPECT_GE(lists.hits().capacity(), 1250 * sizeof(ox_hit));
  EXPECT_GE(lists.contacts().capacity(), 1250 * sizeof(ox_contact));
}

// Every crossing and every hit is one, and may be a region and a contact of its own.
TEST(AppendLists, HaveRoomForTheFeaturesOfAllCrossingsAndHits) {
  Device device("");
  AppendLists lists(device);
  ListCounts counts{};
  counts[OX_LIST_CROSSINGS] = 4000;
  counts[OX_LIST_HITS] = 8000;
  lists.reserve(counts);
  EXPECT_GE(lists.features().capacity(), 15000 * sizeof(ox_feature));
  EXPECT_GE(lists.regions().capacity(), 15000 * sizeof(ox_region));
  EXPECT_GE(lists.members().capacity(), 15000 * OX_MEMBER_WORDS * sizeof(ox_f32));
  EXPECT_GE(lists.candidates().capacity(),
            15000 * OX_CANDIDATES_PER_FEATURE * OX_CANDIDATE_WORDS * sizeof(ox_f32));
  EXPECT_GE(lists.feature_slots().capacity(), OX_SLOTS_PER_FEATURE * 15000 * sizeof(ox_u32));
  EXPECT_GE(lists.faces().capacity(), OX_FACES_PER_FEATURE * 15000 * sizeof(ox_face));
  EXPECT_GE(lists.planes().capacity(),
            OX_PLANES_PER_FEATURE * 15000 * OX_PLANE_WORDS * sizeof(ox_f32));
  EXPECT_GE(lists.feature_parents().capacity(), 15000 * sizeof(ox_u32));
  EXPECT_GE(lists.edge_planes().capacity(), 2 * 15000 * sizeof(ox_u32));
}

TEST(AppendLists, LieBesideOneAnotherWithoutOverlap) {
  Device device("");
  AppendLists lists(device);
  lists.reserve({4, 8, 12, 16, 20, 24, 28, 32, 36, 40, 44, 48});
  EXPECT_EQ(lists.first(List::kChunksSmall), 0u);
  EXPECT_EQ(lists.first(List::kChunks), 5u);
  EXPECT_EQ(lists.first(List::kChunksDeformable), 15u);
  EXPECT_EQ(lists.first(List::kRaysIterative), 0u);
  EXPECT_EQ(lists.first(List::kRays), 20u);
  EXPECT_EQ(lists.first(List::kRaysBasic), 45u);
  EXPECT_EQ(lists.first(List::kMeshlets), 0u);
  EXPECT_EQ(lists.first(List::kMeshletPairs), 0u);
  EXPECT_EQ(lists.first(List::kHits), 0u);
  EXPECT_EQ(lists.first(List::kCrossings), 0u);
  EXPECT_EQ(lists.first(List::kFloodWords), 0u);
  EXPECT_EQ(lists.first(List::kContacts), 0u);
}

TEST(AppendLists, KeepTheirMemoryWhileThereIsRoom) {
  Device device("");
  AppendLists lists(device);
  lists.reserve(all(1000));
  const cl_mem memory = lists.rays().get();
  lists.reserve(all(1250));
  lists.reserve(all(1));
  EXPECT_EQ(lists.capacities(), all(1250));
  EXPECT_EQ(lists.rays().get(), memory);
}

// A batch gets no more of a list than it can need at most; if that is wrong, it is seen.
TEST(AppendLists, OverflowWhereMoreIsCountedThanABatchWasGivenOfThem) {
  Device device("");
  AppendLists lists(device);
  lists.reserve(all(1000));
  lists.begin(all(10));
  EXPECT_FALSE(lists.overflowed(all(10)));
  EXPECT_TRUE(lists.overflowed(all(11)));
}

TEST(AppendLists, CanBeLimitedToExactlyWhatWasPredicted) {
  Device device("");
  AppendLists lists(device);
  lists.reserve(all(1000));
  lists.limit(all(3));
  EXPECT_EQ(lists.capacities(), all(3));
  EXPECT_TRUE(lists.overflowed(all(4)));
}

// A list with more room than there is memory would fail every later batch, however small.
TEST(AppendLists, AreAsEmptyAsBeforeWhereTheDeviceHasNoRoomForThem) {
  Device device("");
  AppendLists lists(device);
  lists.reserve(all(1000));
  EXPECT_THROW(lists.reserve(all(std::uint64_t{1} << 40)), DeviceError);
  EXPECT_EQ(lists.capacities(), all(0));
  EXPECT_EQ(lists.rays().capacity(), 0u);
  lists.reserve(all(1000));
  EXPECT_EQ(lists.capacities(), all(1250));
}

TEST(AppendLists, FindRoomForTheExpectedOnlyAsFarAsItIsCheap) {
  constexpr std::uint64_t kLargest = 1 << 20;  // [bytes]
  Device device("", kLargest);
  AppendLists lists(device);
  EXPECT_EQ(lists.affordable(all(100)), all(100));
  const ListCounts bounded = lists.affordable(all(std::uint64_t{1} << 40));
  lists.reserve(bounded);
  EXPECT_LE(lists.candidates().capacity(), kLargest / 4);
  // Room that is there already costs nothing.
  ListCounts crossings{};
  crossings[OX_LIST_CROSSINGS] = 2000;
  lists.reserve(crossings);
  EXPECT_EQ(lists.affordable(all(2500))[OX_LIST_CROSSINGS], 2500u);
}

TEST(AppendLists, GiveBackWhatNobodyUsedForLong) {
  Device device("");
  AppendLists lists(device);
  const ListCounts peak = all(1000000);
  lists.reserve(peak);
  lists.note_use(peak, true);
  for (int i = 0; i < 255; ++i) lists.note_use(all(1000), true);
  EXPECT_GE(lists.capacities()[0], 1000000u) << "the peak was not long ago";
  for (int i = 0; i < 1000; ++i) lists.note_use(all(1), false);
  EXPECT_GE(lists.capacities()[0], 1000000u) << "single pairs are no passes";
  for (int i = 0; i < 256; ++i) lists.note_use(all(1000), true);
  EXPECT_EQ(lists.capacities(), all(0));
  EXPECT_EQ(lists.candidates().capacity(), 0u);
  EXPECT_EQ(lists.features().capacity(), 0u);
  EXPECT_EQ(lists.faces().capacity(), 0u);
  EXPECT_EQ(lists.planes().capacity(), 0u);
  lists.reserve(all(1000));
  for (int i = 0; i < 1000; ++i) lists.note_use(all(1), true);
  EXPECT_EQ(lists.capacities(), all(1250)) << "so little is not worth growing again";
}

TEST(AppendLists, CanGrowAfterGrowingFailed) {
  Device device("");
  AppendLists lists(device);
  fault_injector::arm(1, CL_MEM_OBJECT_ALLOCATION_FAILURE);
  EXPECT_THROW(lists.reserve(all(100000)), DeviceError);
  fault_injector::disarm();
  lists.reserve(all(100000));
  EXPECT_GE(lists.tasks().capacity(), 3 * 125000 * sizeof(ox_chunk_task));
  EXPECT_GE(lists.contacts().capacity(), 125000 * sizeof(ox_contact));
}

}  // namespace
}  // namespace ode_ext
