// SPDX-License-Identifier: BSD-3-Clause
// What touches in several places has a contact in each of them.
#include <gtest/gtest.h>

#include "support/batch_collider.h"
#include "support/fcl_oracle.h"
#include "support/region_cases.h"
#include "support/region_contacts.h"

namespace ode_ext::test {
namespace {

class RegionContacts : public ::testing::TestWithParam<RegionCase> {};

TEST_P(RegionContacts, AreInEveryRegionOfOverlap) {
  const RegionCase& c = GetParam();
  const auto regions =
      find_regions(SurfaceGraph(c.a), c.pose_a, SurfaceGraph(c.b), c.pose_b,
                   intersecting_triangles(FclSurface(c.a), c.pose_a, FclSurface(c.b), c.pose_b));
  ASSERT_EQ(regions.size(), static_cast<std::size_t>(c.regions));

  OdeWorld world;
  const dGeomID a = world.geom(world.mesh(c.a), c.pose_a);
  const dGeomID b = world.geom(world.mesh(c.b), c.pose_b);
  const Contacts contacts =
      fresh_answer(a, b, 16, [](dBatchColliderParams& params) { params.max_contacts = 16; });
  const double smaller = std::min(mesh_size(c.a), mesh_size(c.b));
  EXPECT_EQ(without_contact(regions, contacts, c.pose_b, smaller).size(), 0u)
      << contacts.size() << " contacts";
}

INSTANTIATE_TEST_SUITE_P(MadeByHand, RegionContacts, ::testing::ValuesIn(region_cases()),
                         [](const auto& made) { return made.param.name; });

}  // namespace
}  // namespace ode_ext::test
