// SPDX-License-Identifier: BSD-3-Clause
#include "support/ode_world.h"

#include <gtest/gtest.h>

namespace ode_ext::test {
namespace {

TEST(OdeWorld, GivesGeomsThePoseAskedFor) {
  OdeWorld world;
  const TestPose pose = Random(1).pose(3);
  const TestPose got = pose_of(world.geom(world.mesh(make_cube(1)), pose));
  EXPECT_EQ(got.position, pose.position);
  EXPECT_EQ(got.rotation, pose.rotation);
}

TEST(OdeWorld, CollectsEveryPairOfEverySpaceKind) {
  OdeWorld world;
  for (const SpaceKind kind : kSpaceKinds) {
    const dSpaceID space = world.space(kind);
    for (const double x : {0.0, 0.5, 5.0}) {
      dGeomSetPosition(world.own(dCreateBox(space, 1, 1, 1)), x, 0, 0);
    }
    Collected collected;
    dSpaceCollide(space, &collected, &collect);
    EXPECT_EQ(collected.order.size(), 1u) << name_of(kind);
    EXPECT_GT(collected.total(), 0) << name_of(kind);
  }
}

TEST(OdeWorld, PilesMeshesSoThatMostOverlapOthers) {
  OdeWorld world;
  const dSpaceID space = world.space(SpaceKind::Simple);
  const Pile pile(world, space, 8, 1);
  Collected collected;
  dSpaceCollide(space, &collected, &collect);
  EXPECT_GE(collected.order.size(), 8u);
}

TEST(Contacts, DifferInASingleBit) {
  dContactGeom c{};
  c.normal[2] = 1;
  dContactGeom negative_zero = c, side = c;
  negative_zero.normal[0] = -0.0;
  side.side2 = 1;
  EXPECT_EQ(difference(Contacts{c}, Contacts{c}), "");
  EXPECT_NE(difference(Contacts{c}, Contacts{negative_zero}), "");
  EXPECT_NE(difference(Contacts{c}, Contacts{side}), "");
  EXPECT_NE(difference(Contacts{c}, Contacts{}), "");
}

TEST(Contacts, FlippedTwiceAreTheSame) {
  OdeWorld world;
  const Contacts contacts =
      collide(world.own(dCreateBox(nullptr, 1, 1, 1)), world.own(dCreateSphere(nullptr, 1)));
  ASSERT_FALSE(contacts.empty());
  EXPECT_NE(difference(flipped(contacts), contacts), "");
  EXPECT_EQ(difference_with_geoms(flipped(flipped(contacts)), contacts), "");
}

TEST(Collected, DifferByPairOrderOrContact) {
  const auto g1 = reinterpret_cast<dGeomID>(8), g2 = reinterpret_cast<dGeomID>(16);
  Collected a;
  a.order = {{g1, g2}, {g2, g1}};
  Collected b = a;
  EXPECT_EQ(difference_with_geoms(a, b), "");
  std::swap(b.order[0], b.order[1]);
  EXPECT_NE(difference_with_geoms(a, b), "");
  b = a;
  a.contacts[{g1, g2}] = {};
  EXPECT_NE(difference_with_geoms(a, b), "");
  b.contacts[{g1, g2}] = {dContactGeom{}};
  EXPECT_NE(difference_with_geoms(a, b), "");
}

}  // namespace
}  // namespace ode_ext::test
