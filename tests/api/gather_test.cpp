// SPDX-License-Identifier: BSD-3-Clause
// Passes over spaces: the callbacks are exactly ODE's, and every mesh pair is computed ahead.
#include <tuple>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

dGeomID as_geom(dSpaceID space) { return reinterpret_cast<dGeomID>(space); }

// The callbacks of ODE, then those of the collider.
void expect_same_callbacks(const BatchCollider& collider, dSpaceID space) {
  Collected plain, batch;
  dSpaceCollide(space, &plain, &collect_order_only);
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, &batch, &collect_order_only), 1)
      << last_error();
  ASSERT_GT(plain.order.size(), 0u);
  EXPECT_EQ(difference_with_geoms(plain, batch), "");
}

long long mesh_pairs(const Collected& collected) {
  long long count = 0;
  for (const auto& [g1, g2] : collected.order) count += is_mesh(g1) && is_mesh(g2);
  return count;
}

class ApiGatherOfSpace : public ::testing::TestWithParam<SpaceKind> {
 protected:
  OdeWorld world;
  dSpaceID space = world.space(GetParam());
  Pile pile{world, space, 8, 1};
  BatchCollider collider;
};

INSTANTIATE_TEST_SUITE_P(Kind, ApiGatherOfSpace, ::testing::ValuesIn(kSpaceKinds),
                         [](const auto& instance) { return name_of(instance.param); });

TEST_P(ApiGatherOfSpace, MakesOdesCallbacksInOdesOrder) { expect_same_callbacks(collider, space); }

TEST_P(ApiGatherOfSpace, MakesOdesCallbacksWithOtherClassesAmongTheMeshes) {
  for (int i = 0; i < 4; ++i) {
    dGeomSetPosition(world.own(dCreateSphere(space, 0.5)), 0.3 * i, 0, 0);
  }
  world.own(dCreatePlane(space, 0, 0, 1, 0));
  expect_same_callbacks(collider, space);
}

TEST_P(ApiGatherOfSpace, PassesOnTheDataPointer) {
  Collected collected;
  EXPECT_EQ(dBatchColliderSpaceCollide(collider, space, &collected, &collect_order_only), 1);
  EXPECT_GT(collected.order.size(), 0u);
}

TEST_P(ApiGatherOfSpace, ComputesEveryMeshPairAhead) {
  const Collected collected = collider.pass(space);
  const auto stats = collider.stats();
  EXPECT_GT(mesh_pairs(collected), 0);
  EXPECT_EQ(stats.pairs, mesh_pairs(collected));
  EXPECT_EQ(stats.pairs_computed, mesh_pairs(collected));
  EXPECT_EQ(stats.pairs_alone, 0);
  EXPECT_EQ(stats.passes, 1);
  EXPECT_EQ(stats.status, 0u);
}

TEST_P(ApiGatherOfSpace, FiltersByBitsBodiesAndEnabledAsOdeDoes) {
  const dWorldID physics = dWorldCreate();
  const dBodyID body = dBodyCreate(physics);
  dGeomSetCategoryBits(pile.geoms[0], 1);
  dGeomSetCollideBits(pile.geoms[0], 2);
  dGeomSetCategoryBits(pile.geoms[1], 4);
  dGeomSetCollideBits(pile.geoms[1], 1);  // one direction suffices
  dGeomSetCollideBits(pile.geoms[2], 0);
  dGeomSetCategoryBits(pile.geoms[2], 0);  // meets nobody
  dGeomDisable(pile.geoms[3]);
  for (const int i : {4, 5}) dGeomSetBody(pile.geoms[static_cast<std::size_t>(i)], body);
  expect_same_callbacks(collider, space);
  EXPECT_EQ(collider.stats().pairs, mesh_pairs(collider.pass(space)));
  for (const int i : {4, 5}) dGeomSetBody(pile.geoms[static_cast<std::size_t>(i)], nullptr);
  dBodyDestroy(body);
  dWorldDestroy(physics);
}

// Programs recurse from the callback with dSpaceCollide2 and dSpaceCollide: whatever they can reach
// that way is in the batch.
TEST_P(ApiGatherOfSpace, ReachesIntoNestedSpaces) {
  const dSpaceID outer = world.space(SpaceKind::Simple);
  const dSpaceID inner = world.space(GetParam(), outer), twin = world.space(GetParam(), outer);
  const Pile in_inner(world, inner, 5, 2), in_twin(world, twin, 5, 3), in_outer(world, outer, 3, 4);
  expect_same_callbacks(collider, outer);
  Collected collected;
  collected.recurse = true;
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, outer, &collected, &collect), 1) << last_error();
  const auto ahead = collider.stats();
  EXPECT_GT(mesh_pairs(collected), 10);
  EXPECT_EQ(ahead.pairs_alone, 0);
  for (const dSpaceID space_in : {inner, twin}) dSpaceCollide(space_in, &collected, &collect);
  EXPECT_EQ(collider.stats().pairs_alone, 0);
  EXPECT_EQ(ahead.pairs, mesh_pairs(collected));
}

class ApiGatherOfTwo : public ::testing::TestWithParam<std::tuple<SpaceKind, SpaceKind>> {
 protected:
  void expect_same_callbacks2(dGeomID g1, dGeomID g2) {
    Collected plain, batch;
    dSpaceCollide2(g1, g2, &plain, &collect_order_only);
    ASSERT_EQ(dBatchColliderSpaceCollide2(collider, g1, g2, &batch, &collect), 1) << last_error();
    ASSERT_GT(plain.order.size(), 0u);
    EXPECT_EQ(plain.order, batch.order);
    EXPECT_EQ(collider.stats().pairs_alone, 0);
    EXPECT_EQ(collider.stats().pairs, mesh_pairs(batch));
  }

  OdeWorld world;
  dSpaceID s1 = world.space(std::get<0>(GetParam())), s2 = world.space(std::get<1>(GetParam()));
  Pile p1{world, s1, 4, 1}, p2{world, s2, 6, 2};
  BatchCollider collider;
};

INSTANTIATE_TEST_SUITE_P(Kinds, ApiGatherOfTwo,
                         ::testing::Combine(::testing::ValuesIn(kSpaceKinds),
                                            ::testing::ValuesIn(kSpaceKinds)),
                         [](const auto& instance) {
                           return std::string(name_of(std::get<0>(instance.param))) +
                                  name_of(std::get<1>(instance.param));
                         });

TEST_P(ApiGatherOfTwo, SpacesMakesOdesCallbacks) {
  expect_same_callbacks2(as_geom(s1), as_geom(s2));
}

TEST_P(ApiGatherOfTwo, SpacesWithSublevelsMakesOdesCallbacks) {
  dSpaceSetSublevel(s1, 1);
  Collected plain, batch;
  dSpaceCollide2(as_geom(s1), as_geom(s2), &plain, &collect_order_only);
  ASSERT_EQ(
      dBatchColliderSpaceCollide2(collider, as_geom(s1), as_geom(s2), &batch, &collect_order_only),
      1);
  ASSERT_GT(plain.order.size(), 0u);
  EXPECT_EQ(plain.order, batch.order);
}

TEST_P(ApiGatherOfTwo, ASpaceAndAGeomMakesOdesCallbacks) {
  expect_same_callbacks2(as_geom(s2), p1.geoms[0]);
  expect_same_callbacks2(p1.geoms[0], as_geom(s2));
}

TEST_P(ApiGatherOfTwo, TheSameSpaceTwiceMakesOdesCallbacks) {
  expect_same_callbacks2(as_geom(s2), as_geom(s2));
}

TEST(ApiGatherOfGeoms, IsOnePair) {
  OdeWorld world;
  const OdeMesh& cube = world.mesh(make_cube(1));
  const dGeomID g1 = world.geom(cube, {}), g2 = world.geom(cube, at(0.5, 0.25, 0.125));
  const BatchCollider collider;
  Collected collected;
  ASSERT_EQ(dBatchColliderSpaceCollide2(collider, g1, g2, &collected, &collect), 1);
  EXPECT_EQ(collected.order, (std::vector<GeomPair>{{g1, g2}}));
  EXPECT_EQ(collider.stats().pairs_computed, 1);
  EXPECT_EQ(collider.stats().pairs_alone, 0);
}

// ODE's filter for members leaves this one through; so does the batch.
TEST(ApiGatherOfGeoms, CallsBackForADisabledGeomAsOdeDoes) {
  OdeWorld world;
  const OdeMesh& cube = world.mesh(make_cube(1));
  const dGeomID g1 = world.geom(cube, {}), g2 = world.geom(cube, at(0.5, 0.25, 0.125));
  dGeomDisable(g1);
  const BatchCollider collider;
  Collected plain, batch;
  dSpaceCollide2(g1, g2, &plain, &collect_order_only);
  ASSERT_EQ(dBatchColliderSpaceCollide2(collider, g1, g2, &batch, &collect_order_only), 1);
  EXPECT_EQ(plain.order, batch.order);
}

}  // namespace
}  // namespace ode_ext::test
