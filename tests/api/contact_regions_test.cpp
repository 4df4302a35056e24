// SPDX-License-Identifier: BSD-3-Clause
// dBatchColliderGetContactRegions: in which region of overlap each contact is, and whether the
// surfaces cross there or one is inside the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/batch_collider.h"
#include "support/region_cases.h"

namespace ode_ext::test {
namespace {

using Regions = std::vector<dBatchContactRegion>;

Regions regions_as_found(dBatchColliderID collider, const Contacts& contacts) {
  Regions regions(contacts.size(), {7, 7});
  const int found =
      dBatchColliderGetContactRegions(collider, contacts.data(), static_cast<int>(contacts.size()),
                                      sizeof(dContactGeom), regions.data());
  EXPECT_EQ(found, std::count_if(regions.begin(), regions.end(),
                                 [](const auto& region) { return region.region >= 0; }));
  return regions;
}

// Of all contacts of one pair: numbered in their order.
Regions regions_of(dBatchColliderID collider, const Contacts& contacts) {
  Regions regions = regions_as_found(collider, contacts);
  int next = 0;
  for (const auto& [region, overlap] : regions) {
    EXPECT_GE(region, 0);
    EXPECT_LE(region, next);
    next = std::max(next, region + 1);
  }
  return regions;
}

int region_count(const Regions& regions) {
  std::set<int> numbers;
  for (const auto& region : regions) numbers.insert(region.region);
  return static_cast<int>(numbers.size());
}

std::set<int> overlaps(const Regions& regions) {
  std::set<int> kinds;
  for (const auto& region : regions) kinds.insert(region.overlap);
  return kinds;
}

std::vector<int> numbers(const Regions& regions) {
  std::vector<int> result;
  for (const auto& region : regions) result.push_back(region.region);
  return result;
}

class ContactRegions : public ::testing::TestWithParam<RegionCase> {
 protected:
  OdeWorld world;
  BatchCollider collider;
};

TEST_P(ContactRegions, AreAsManyAsThereAreAndCross) {
  const RegionCase& c = GetParam();
  const OdeMesh &a = world.mesh(c.a), &b = world.mesh(c.b);
  for (const bool deformable : {false, true}) {
    dBatchColliderTriMeshDataSetDeformable(collider, a.id(), deformable);
    const Contacts contacts =
        answer_of(collider, world.geom(a, c.pose_a), world.geom(b, c.pose_b), 1000);
    const Regions regions = regions_of(collider, contacts);
    EXPECT_EQ(region_count(regions), c.regions);
    EXPECT_EQ(overlaps(regions), std::set<int>{dBatchOverlapCrossing});
  }
}

INSTANTIATE_TEST_SUITE_P(MadeByHand, ContactRegions, ::testing::ValuesIn(region_cases()),
                         [](const auto& made) { return made.param.name; });

class ApiContactRegions : public ::testing::Test {
 protected:
  OdeWorld world;
  BatchCollider collider;
  dGeomID block = world.geom(world.mesh(make_cube(1)), {});
  dGeomID grain = world.geom(world.mesh(make_icosphere(0.1, 1)), at(0.3, 0.2, 0.1));
};

TEST_F(ApiContactRegions, SayWhichOfTheTwoIsInside) {
  const Contacts inside = answer_of(collider, grain, block);
  ASSERT_FALSE(inside.empty());
  EXPECT_EQ(overlaps(regions_of(collider, inside)), std::set<int>{dBatchOverlapFirstInside});
  const Contacts around = answer_of(collider, block, grain);
  ASSERT_FALSE(around.empty());
  EXPECT_EQ(overlaps(regions_of(collider, around)), std::set<int>{dBatchOverlapSecondInside});
}

TEST_F(ApiContactRegions, TellAPartThatIsInsideFromOneThatCrosses) {
  const TestMesh crossing = moved(make_cube(0.2), {0.5, 0, 0});
  const dGeomID both = world.geom(world.mesh(merged(crossing, make_cube(0.2))), at(0, 0.05, 0.03));
  const Regions regions = regions_of(collider, answer_of(collider, both, block));
  EXPECT_EQ(region_count(regions), 2);
  EXPECT_EQ(overlaps(regions), (std::set<int>{dBatchOverlapCrossing, dBatchOverlapFirstInside}));
  for (const auto& one : regions)
    for (const auto& other : regions)
      EXPECT_EQ(one.region == other.region, one.overlap == other.overlap);
}

TEST_F(ApiContactRegions, AreTheSameAloneAndInABatch) {
  dSpaceID space = world.space(SpaceKind::Simple);
  const Pile pile(world, space, 16, 3);
  const Collected collected = collider.pass(space);
  const BatchCollider late;
  std::set<int> found;
  int pairs = 0;
  for (const auto& [pair, contacts] : collected.contacts) {
    if (contacts.empty()) continue;
    const Regions regions = regions_of(collider, contacts);
    found.insert(region_count(regions));
    ASSERT_EQ(difference(answer_of(late, pair.first, pair.second), contacts), "");
    const Regions alone = regions_of(late, contacts);
    EXPECT_EQ(numbers(alone), numbers(regions));
    EXPECT_EQ(overlaps(alone), overlaps(regions));
    ++pairs;
  }
  EXPECT_GT(pairs, 20);
  EXPECT_GT(*found.rbegin(), 1);
}

TEST_F(ApiContactRegions, AreKnownButNotWhatCrossesWhereCrossingsAreNotLookedFor) {
  const BatchCollider vertices(with("edges=off"));
  const Regions regions = regions_of(vertices, answer_of(vertices, grain, block));
  EXPECT_EQ(overlaps(regions), std::set<int>{dBatchOverlapNone});
}

TEST_F(ApiContactRegions, AreNoneOfContactsThatNobodyGaveAndWithAColliderOfZero) {
  Contacts contacts = answer_of(collider, grain, block);
  for (const auto& region : regions_as_found(nullptr, contacts)) EXPECT_EQ(region.region, -1);
  for (dContactGeom& contact : contacts) contact.depth *= 2;
  for (const auto& region : regions_as_found(collider, contacts)) {
    EXPECT_EQ(region.region, -1);
    EXPECT_EQ(region.overlap, dBatchOverlapNone);
  }
}

TEST_F(ApiContactRegions, RefuseWhatCannotBe) {
  const Contacts contacts = answer_of(collider, grain, block);
  Regions regions(contacts.size(), {7, 7});
  const int skip = sizeof(dContactGeom);
  const auto ask = [&](const dContactGeom* from, int number, int stride, dBatchContactRegion* to) {
    return dBatchColliderGetContactRegions(collider, from, number, stride, to);
  };
  EXPECT_EQ(ask(nullptr, 1, skip, regions.data()), -1);
  EXPECT_EQ(last_error(), "dBatchColliderGetContactRegions: contacts is NULL");
  EXPECT_EQ(ask(contacts.data(), 1, skip, nullptr), -1);
  EXPECT_EQ(last_error(), "dBatchColliderGetContactRegions: regions is NULL");
  EXPECT_EQ(ask(contacts.data(), -1, skip, regions.data()), -1);
  EXPECT_EQ(ask(contacts.data(), 1, skip - 1, regions.data()), -1);
  EXPECT_EQ(regions[0].region, 7) << "nothing may be written";
  EXPECT_EQ(ask(nullptr, 0, skip, nullptr), 0);
  const dBatchColliderID gone = collider;
  collider.destroy();
  EXPECT_EQ(dBatchColliderGetContactRegions(gone, contacts.data(), 1, skip, regions.data()), -1);
}

}  // namespace
}  // namespace ode_ext::test
