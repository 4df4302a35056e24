// SPDX-License-Identifier: BSD-3-Clause
#include "support/regions.h"

#include <gtest/gtest.h>

#include "support/fcl_oracle.h"
#include "support/region_cases.h"
#include "support/region_contacts.h"

namespace ode_ext::test {
namespace {

std::vector<Region> regions_of(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                               const TestPose& pb) {
  return find_regions(SurfaceGraph(a), pa, SurfaceGraph(b), pb,
                      intersecting_triangles(FclSurface(a), pa, FclSurface(b), pb));
}

class Regions : public ::testing::TestWithParam<RegionCase> {};

TEST_P(Regions, AreAsManyAsOneSees) {
  const RegionCase& c = GetParam();
  EXPECT_EQ(regions_of(c.a, c.pose_a, c.b, c.pose_b).size(), static_cast<std::size_t>(c.regions));
}

TEST_P(Regions, AreAsManyWithTheMeshesExchangedAndFarAway) {
  const RegionCase& c = GetParam();
  const TestPose frame = turned({1, -2, 0.5}, 1.2, {1e5, -2e5, 3e5});
  const auto regions = regions_of(c.b, composed(frame, c.pose_b), c.a, composed(frame, c.pose_a));
  EXPECT_EQ(regions.size(), static_cast<std::size_t>(c.regions));
}

INSTANTIATE_TEST_SUITE_P(MadeByHand, Regions, ::testing::ValuesIn(region_cases()),
                         [](const auto& made) { return made.param.name; });

TEST(Regions, AreNoneWhereMeshesAreApartOrOneInsideTheOther) {
  EXPECT_TRUE(regions_of(make_cube(1), at(0, 0, 3), make_cube(1), {}).empty());
  EXPECT_TRUE(regions_of(make_cube(1), {}, make_cube(3), {}).empty());
}

// Both slopes are neighbours, and dip into the same triangle, without the ridge between them.
TEST(Regions, AreTwoWhereBothSlopesOfARoofDipIntoOneTriangle) {
  TestMesh roof;
  roof.vertices = {-1, 0, 1, 1, 0, 1, 0, -1, -0.1f, 0, 1, -0.1f};
  roof.indices = {0, 1, 3, 1, 0, 2};
  EXPECT_EQ(regions_of(roof, {}, make_triangle(8), at(0, 1, 0)).size(), 2u);
  // Turned until the ridge comes through as well.
  const TestPose tilted = turned({0, 1, 0}, 0.9, {0, 0, -0.1});
  EXPECT_EQ(regions_of(roof, tilted, make_triangle(8), at(0, 1, 0)).size(), 1u);
}

TEST(Regions, ReachFromTheCurveToTheDeepestVertex) {
  const auto regions =
      regions_of(make_cube(1), turned({1, 1, 1}, 1e-3, {0, 0, 1.2}), make_box({4, 4, 2}), {});
  ASSERT_EQ(regions.size(), 1u);
  EXPECT_NEAR(regions[0].low[2], 0.7, 0.01);  // the cube's underside
  EXPECT_NEAR(regions[0].high[2], 1.0, 0.01);
  EXPECT_NEAR(regions[0].size(), 1.0, 0.01);
}

dContactGeom contact_at(const Point& p, const Point& n, double depth) {
  dContactGeom contact{};
  for (std::size_t k = 0; k < 3; ++k) {
    contact.pos[k] = p[k];
    contact.normal[k] = n[k];
  }
  contact.depth = depth;
  return contact;
}

TEST(Coverage, NeedsAContactInTheRegionOrOnTheWayOutOfIt) {
  const std::vector<Region> regions{{{0, 0, 0}, {1, 1, 0.1}}, {{3, 0, 0}, {4, 1, 0.1}}};
  const TestPose pose = turned({0, 0, 1}, 0.5, {7, 8, 9});
  const auto bare = [&](const Point& local, double depth) {
    const dContactGeom contact = contact_at(to_world(pose, local), rotate(pose, {0, 0, 1}), depth);
    return without_contact(regions, {&contact, 1}, pose, 1).size();
  };
  EXPECT_EQ(without_contact(regions, {}, pose, 1).size(), 2u);
  EXPECT_EQ(bare({0.5, 0.5, 0.05}, 0), 1u);
  EXPECT_EQ(bare({3.5, 0.5, 0.05}, 0), 1u);
  EXPECT_EQ(bare({2, 0.5, 0.05}, 0), 2u);     // between them
  EXPECT_EQ(bare({2, 0.5, 0.05}, 5), 2u);     // a deep one covers along its normal only
  EXPECT_EQ(bare({0.5, 0.5, 0.4}, 0.3), 1u);  // the way leads into the region
  EXPECT_EQ(bare({0.5, 0.5, 0.4}, 0.2), 2u);  // stops 0.1 before it
  EXPECT_EQ(bare({1.04, 0.5, 0.05}, 0), 1u);  // as good as in it
}

}  // namespace
}  // namespace ode_ext::test
