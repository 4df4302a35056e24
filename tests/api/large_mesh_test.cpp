// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

// A block pressed 5 mm onto a lying torus of 2 M triangles: its highest vertices are the deepest,
// 5 mm above the block's lower face, and the separation is up. No deeper: it is the mesh that is
// large here, and what is to be looked at in a contact grows with the square of what meets.
TEST(ApiLargeMesh, OfTwoMillionTrianglesCollides) {
  OdeWorld world;
  const dSpaceID space = world.space(SpaceKind::Simple);
  const OdeMesh& large = world.mesh(make_torus(1.0, 0.5, 1000, 1000));
  ASSERT_EQ(large.mesh().triangle_count(), 2'000'000);
  const OdeMesh& cube = world.mesh(make_cube(4.0, 4));
  const dGeomID below = world.geom(large, {}, space);
  const dGeomID above = world.geom(cube, at(0, 0, 2.495), space);

  const BatchCollider collider;
  collider.pass(space);
  EXPECT_EQ(collider.stats().pairs_computed, 1);
  const Contacts contacts = collide(above, below, 16);
  ASSERT_FALSE(contacts.empty());
  // 2^-20 of the pair's extents (pair_step.cl), about 6 m.
  EXPECT_NEAR(contacts[0].depth, 0.005, 6e-6);
  EXPECT_NEAR(contacts[0].normal[2], 1, 1e-6);
}

}  // namespace
}  // namespace ode_ext::test
