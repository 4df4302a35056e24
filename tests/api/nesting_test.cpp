// SPDX-License-Identifier: BSD-3-Clause
// Calls of this library from inside a near callback.
#include <algorithm>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

class ApiNesting : public ::testing::Test {
 protected:
  OdeWorld world;
  dSpaceID outer = world.space(SpaceKind::Hash);
  dSpaceID inner = world.space(SpaceKind::Simple, outer);
  Pile in_outer{world, outer, 4, 1}, in_inner{world, inner, 5, 2};
  BatchCollider collider;
};

struct Context {
  dBatchColliderID collider;
  Collected collected;
  bool entered = false;
  int result = 0;
  PassStatistics stats{};
};

TEST_F(ApiNesting, APassOverAContainedSpaceRunsNoSecondBatch) {
  Context context{collider, {}};
  const auto callback = [](void* data, dGeomID o1, dGeomID o2) {
    auto& c = *static_cast<Context*>(data);
    const dGeomID space = dGeomIsSpace(o1) ? o1 : o2;
    if (!dGeomIsSpace(space) || c.entered) return;
    c.entered = true;
    c.result = dBatchColliderSpaceCollide(c.collider, reinterpret_cast<dSpaceID>(space),
                                          &c.collected, &collect);
    c.stats = pass_statistics(c.collider);
  };
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, outer, &context, callback), 1) << last_error();
  ASSERT_TRUE(context.entered);
  EXPECT_EQ(context.result, 1);
  EXPECT_GT(context.collected.total(), 0);
  EXPECT_EQ(context.stats.pairs, static_cast<long long>(context.collected.order.size()));
  EXPECT_EQ(context.stats.pairs_computed, 0);
  EXPECT_EQ(context.stats.pairs_alone, 0);
}

// More inner passes than answers are remembered for: they are part of one pass of the program.
TEST_F(ApiNesting, ManyInnerPassesRunNoSecondBatch) {
  struct Many {
    dBatchColliderID collider;
    std::vector<dSpaceID> spaces;
    int calls = 0;
    long long gathered = 0, computed = 0;
  } context{collider, {}};
  const OdeMesh& cube = world.mesh(make_cube(1));
  for (int i = 0; i < 20; ++i) {
    context.spaces.push_back(world.space(SpaceKind::Simple, outer));
    world.geom(cube, at(10.0 * i + 20, 0, 0), context.spaces.back());
    world.geom(cube, at(10.0 * i + 20.5, 0.25, 0.125), context.spaces.back());
    world.geom(cube, at(10.0 * i + 20.25, 0.9, 0.125), outer);  // so that the pass meets the space
  }
  const auto callback = [](void* data, dGeomID, dGeomID) {
    auto& c = *static_cast<Many*>(data);
    if (c.calls++ != 0) return;
    for (const dSpaceID space : c.spaces) {
      Collected collected;
      EXPECT_EQ(dBatchColliderSpaceCollide(c.collider, space, &collected, &collect), 1);
      c.gathered += dBatchColliderGetCount(c.collider, dBatchCounterPairs);
      c.computed += dBatchColliderGetCount(c.collider, dBatchCounterPairsComputed);
    }
  };
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, outer, &context, callback), 1) << last_error();
  ASSERT_GT(context.calls, 0);
  EXPECT_EQ(context.gathered, 20);
  EXPECT_EQ(context.computed, 0);
  EXPECT_EQ(collider.stats().pairs_alone, 0);
}

TEST_F(ApiNesting, APassOfTwoGeomsRunsNoSecondBatch) {
  Context context{collider, {}};
  const auto callback = [](void* data, dGeomID o1, dGeomID o2) {
    auto& c = *static_cast<Context*>(data);
    if (dGeomIsSpace(o1) || dGeomIsSpace(o2)) return;
    c.entered = true;
    c.result = dBatchColliderSpaceCollide2(c.collider, o1, o2, &c.collected, &collect);
    c.stats = pass_statistics(c.collider);
  };
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, outer, &context, callback), 1);
  ASSERT_TRUE(context.entered);
  EXPECT_EQ(context.result, 1);
  EXPECT_EQ(context.stats.pairs_computed, 0);
}

TEST_F(ApiNesting, AnInnerPassThatComputesLeavesTheOuterAnswersAlone) {
  const Collected alone = collider.pass(outer);
  const dSpaceID elsewhere = world.space(SpaceKind::Simple);
  Pile other(world, elsewhere, 5, 3, {100, 0, 0});
  struct Inner {
    dBatchColliderID collider;
    dSpaceID elsewhere;
    Collected of_outer, of_elsewhere;
  } context{collider, elsewhere, {}, {}};
  const auto callback = [](void* data, dGeomID o1, dGeomID o2) {
    auto& c = *static_cast<Inner*>(data);
    dBatchColliderSpaceCollide(c.collider, c.elsewhere, &c.of_elsewhere, &collect);
    collect(&c.of_outer, o1, o2);
  };
  in_outer.shake(1);  // the poses it had: nothing may differ
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, outer, &context, callback), 1);
  EXPECT_EQ(difference_with_geoms(context.of_outer, alone), "");
  EXPECT_GT(context.of_elsewhere.total(), 0);
}

TEST_F(ApiNesting, CollidePairsInACallbackAnswersAsThePass) {
  struct Pairs {
    dBatchColliderID collider;
    int compared = 0;
  } context{collider};
  const auto callback = [](void* data, dGeomID o1, dGeomID o2) {
    auto& c = *static_cast<Pairs*>(data);
    if (!is_mesh(o1) || !is_mesh(o2)) return;
    Contacts contacts(64);
    const dGeomID pair[] = {o1, o2};
    const int total = dBatchColliderCollidePairs(c.collider, pair, 1, 64, contacts.data(),
                                                 sizeof(dContactGeom), nullptr);
    ASSERT_GE(total, 0) << last_error();
    contacts.resize(static_cast<std::size_t>(total));
    EXPECT_EQ(difference_with_geoms(contacts, collide(o1, o2)), "");
    ++c.compared;
  };
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, outer, &context, callback), 1);
  EXPECT_GT(context.compared, 0);
}

TEST_F(ApiNesting, APassOfAnotherColliderAnswersItsOwnQuestions) {
  BatchCollider single([](dBatchColliderParams& p) { p.max_contacts = 1; });
  struct Two {
    dBatchColliderID single;
    Collected of_single, of_outer;
  } context{single, {}, {}};
  const auto callback = [](void* data, dGeomID o1, dGeomID o2) {
    auto& c = *static_cast<Two*>(data);
    if (dGeomIsSpace(o1) || dGeomIsSpace(o2)) return;
    EXPECT_EQ(dBatchColliderSpaceCollide2(c.single, o1, o2, &c.of_single, &collect), 1);
    collect(&c.of_outer, o1, o2);  // the outer pass runs again
  };
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, outer, &context, callback), 1);
  std::size_t most = 0;
  EXPECT_GT(context.of_single.total(), 0);
  for (const auto& [pair, contacts] : context.of_single.contacts) {
    EXPECT_LE(contacts.size(), 1u);
  }
  for (const auto& [pair, contacts] : context.of_outer.contacts) {
    most = std::max(most, contacts.size());
  }
  EXPECT_GT(most, 1u);
}

TEST_F(ApiNesting, DestroyingTheColliderInItsCallbackIsRefused) {
  Context context{collider, {}};
  const auto callback = [](void* data, dGeomID, dGeomID) {
    auto& c = *static_cast<Context*>(data);
    c.entered = true;
    dBatchColliderDestroy(c.collider);
    EXPECT_NE(last_error(), "");
  };
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, outer, &context, callback), 1);
  EXPECT_TRUE(context.entered);
  EXPECT_GT(collider.pass(outer).total(), 0);  // alive and well
}

TEST_F(ApiNesting, DestroyingAnotherColliderInACallbackWorks) {
  BatchCollider other;
  struct Other {
    BatchCollider* collider;
  } context{&other};
  const auto callback = [](void* data, dGeomID, dGeomID) {
    static_cast<Other*>(data)->collider->destroy();
  };
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, outer, &context, callback), 1);
  EXPECT_GT(collider.pass(outer).total(), 0);
}

TEST_F(ApiNesting, ACallbackThatThrowsLeavesTheColliderUsable) {
  const auto callback = [](void*, dGeomID, dGeomID) { throw 1; };
  // It may pass through ODE, which is compiled as C++, or be caught at the border.
  try {
    dBatchColliderSpaceCollide2(collider, in_outer.geoms[0], in_outer.geoms[1], nullptr, callback);
  } catch (int) {
  }
  EXPECT_GT(collider.pass(inner).total(), 0);
}

}  // namespace
}  // namespace ode_ext::test
