// SPDX-License-Identifier: BSD-3-Clause
// Meshes that change, announced or not, are rebuilt, and handles of destroyed ones never touched.
#include <algorithm>

#include "support/batch_collider.h"
#include "support/forged_meshes.h"

namespace ode_ext::test {
namespace {

BatchCollider::Change trusting() {
  return [](dBatchColliderParams& p) { p.trust_meshes = 1; };
}

class ApiMeshes : public ::testing::Test {
 public:  // callbacks, plain functions, use it too
  // Dents the cube so that the box ODE keeps for it still holds it.
  void dent() {
    for (float& c : soft.edit().vertices) c *= 0.875f;
    dGeomTriMeshDataUpdate(soft.id());
  }
  Contacts right() { return fresh_answer(g1, g2); }
  static TestPose place() { return turned({1, 2, 3}, 1, {0.7, 0.25, 0.125}); }

  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Simple);
  OdeMesh& soft = world.mesh(make_cube(1, 2));
  OdeMesh& hard = world.mesh(make_icosphere(0.6, 2));
  dGeomID g1 = world.geom(soft, place(), space);
  dGeomID g2 = world.geom(hard, {}, space);
};

TEST_F(ApiMeshes, EditedInPlaceAreSeenAtTheNextPassUnannounced) {
  const BatchCollider collider;
  collider.pass(space);
  const Contacts before = collide(g1, g2);
  dent();
  collider.pass(space);
  const Contacts after = collide(g1, g2);
  EXPECT_NE(difference(after, before), "");
  EXPECT_EQ(difference_with_geoms(after, right()), "");
}

// As by a program that never makes a pass.
TEST_F(ApiMeshes, EditedInPlaceAreSeenByAQuestionOutsideOfPasses) {
  const BatchCollider collider;
  const Contacts before = collide(g1, g2);
  EXPECT_EQ(difference_with_geoms(before, right()), "");
  dent();
  const Contacts after = collide(g1, g2);
  EXPECT_NE(difference(after, before), "");
  EXPECT_EQ(difference_with_geoms(after, right()), "");
}

TEST_F(ApiMeshes, EditedInPlaceAreSeenAfterAPassThatDoesNotMeetThem) {
  const BatchCollider collider;
  const dSpaceID other = world.space(SpaceKind::Simple);
  world.geom(hard, {}, other);
  world.geom(hard, at(0.5, 0, 0), other);
  collider.pass(space);
  dent();
  collider.pass(other);
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), right()), "");
}

TEST_F(ApiMeshes, EditedInPlaceAreSeenAfterPassesInWhichNobodyAskedForThem) {
  const BatchCollider collider;
  collider.pass(space);
  const auto sleep = [&](int passes) {
    const auto ask_nothing = [](void*, dGeomID, dGeomID) {};
    for (int i = 0; i < passes; ++i)
      ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, nullptr, ask_nothing), 1);
  };
  sleep(12);
  dent();
  sleep(3);
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), right()), "");
}

TEST_F(ApiMeshes, ThatAreTrustedAreNotReadByAQuestion) {
  const BatchCollider collider(trusting());
  const Contacts before = collide(g1, g2);
  dent();
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), before), "");
}

TEST_F(ApiMeshes, EditedInPlaceAreSeenAtOnceWhenAnnounced) {
  const BatchCollider collider;
  collider.pass(space);
  const Contacts before = collide(g1, g2);
  dent();
  dBatchColliderTriMeshDataUpdate(collider, soft.id());
  const Contacts after = collide(g1, g2);
  EXPECT_NE(difference(after, before), "");
  EXPECT_EQ(difference_with_geoms(after, right()), "");
}

TEST_F(ApiMeshes, AnnouncedToColliderZeroAreSeenByAll) {
  const BatchCollider one, two;
  one.pass(space);
  two.pass(space);
  dent();
  dBatchColliderTriMeshDataUpdate(nullptr, soft.id());
  const Contacts expected = right();
  for (const BatchCollider* collider : {&one, &two}) {
    Contacts contacts(64);
    const dGeomID pair[] = {g1, g2};
    const int total = dBatchColliderCollidePairs(*collider, pair, 1, 64, contacts.data(),
                                                 sizeof(dContactGeom), nullptr);
    ASSERT_GE(total, 0) << last_error();
    contacts.resize(static_cast<std::size_t>(total));
    EXPECT_EQ(difference_with_geoms(contacts, expected), "");
  }
}

TEST_F(ApiMeshes, AnnouncedInsideACallbackAreSeenInIt) {
  const BatchCollider collider;
  struct Context {
    ApiMeshes* test;
    dBatchColliderID collider;
    Contacts before, after;
  } context{this, collider, {}, {}};
  const auto callback = [](void* data, dGeomID o1, dGeomID o2) {
    auto& c = *static_cast<Context*>(data);
    c.before = collide(o1, o2);
    c.test->dent();
    dBatchColliderTriMeshDataUpdate(c.collider, c.test->soft.id());
    c.after = collide(c.test->g1, c.test->g2);
  };
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, &context, callback), 1);
  ASSERT_FALSE(context.before.empty());
  EXPECT_NE(difference(context.after, context.before), "");
  EXPECT_EQ(difference_with_geoms(context.after, right()), "");
}

// By the arrays that they are of: nothing else tells without reading all of them.
TEST_F(ApiMeshes, ReplacedOrBuiltAgainInsideACallbackAreSeenInIt) {
  const BatchCollider collider;
  struct Context {
    OdeWorld& world;
    OdeMesh& mesh;
    dGeomID other, geom;
    Contacts before, replaced, built;
  } context{world, world.mesh(make_cube(1, 2)), g2, nullptr, {}, {}, {}};
  context.geom = world.geom(context.mesh, place());  // in no space, which is locked
  const auto callback = [](void* data, dGeomID, dGeomID) {
    auto& c = *static_cast<Context*>(data);
    c.before = collide(c.geom, c.other);
    c.world.destroy(c.geom);
    ASSERT_TRUE(c.mesh.replace_at_same_address(make_cube(0.1, 2)));
    c.geom = c.world.geom(c.mesh, place());
    c.replaced = collide(c.geom, c.other);
    c.mesh.rebuild(make_cube(1.1, 2));
    dGeomTriMeshSetData(c.geom, c.mesh.id());
    c.built = collide(c.geom, c.other);
  };
  ASSERT_EQ(dBatchColliderSpaceCollide(collider, space, &context, callback), 1);
  EXPECT_FALSE(context.before.empty());
  EXPECT_TRUE(context.replaced.empty());
  EXPECT_EQ(difference_with_geoms(context.built, fresh_answer(context.geom, g2)), "");
  EXPECT_FALSE(context.built.empty());
}

TEST_F(ApiMeshes, BuiltAgainAreSeenAtTheNextPass) {
  const BatchCollider collider;
  collider.pass(space);
  soft.rebuild(make_torus(0.5, 0.2, 12, 8));
  set_mesh(g1, soft.id());  // ODE sizes the geom's box only now
  collider.pass(space);
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), right()), "");
  EXPECT_FALSE(collide(g1, g2).empty());
}

// Same number of triangles at the same place in memory: only the content tells.
TEST_F(ApiMeshes, WithTheSameTriangleCountButOtherIndicesAreSeen) {
  const BatchCollider collider;
  collider.pass(space);
  const Contacts before = collide(g1, g2);
  auto& indices = soft.edit().indices;
  std::rotate(indices.begin(), indices.begin() + 3, indices.end());  // renumbers the triangles
  dGeomTriMeshDataUpdate(soft.id());
  collider.pass(space);
  const Contacts after = collide(g1, g2);
  ASSERT_EQ(after.size(), before.size());
  EXPECT_NE(difference(after, before), "");
  EXPECT_EQ(difference_with_geoms(after, right()), "");
}

class ApiMeshesOfOneHash : public ApiMeshes {
 protected:
  void SetUp() override {
    set_pose(g1, {});
    set_pose(g2, at(0.5, 3, 3));  // on the plate, far off the cube
  }

  const std::array<TestMesh, 2> forged = cube_and_plate_of_one_hash();
  OdeMesh& cube = world.mesh(forged[0]);
  OdeMesh& plate = world.mesh(forged[1]);
};

TEST_F(ApiMeshesOfOneHash, AreToldApart) {
  const BatchCollider collider;
  set_mesh(g1, cube.id());
  collider.pass(space);
  EXPECT_TRUE(collide(g1, g2).empty());
  set_mesh(g1, plate.id());
  collider.pass(space);
  EXPECT_FALSE(collide(g1, g2).empty());
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), right()), "");
}

TEST_F(ApiMeshesOfOneHash, AreSeenWhereOneIsEditedIntoTheOther) {
  const BatchCollider collider;
  set_mesh(g1, plate.id());  // the larger box is the one that ODE keeps
  collider.pass(space);
  EXPECT_FALSE(collide(g1, g2).empty());
  plate.edit().vertices = forged[0].vertices;
  dGeomTriMeshDataUpdate(plate.id());
  collider.pass(space);
  EXPECT_TRUE(collide(g1, g2).empty());
}

// ODE gives a new dTriMeshData the address of the one just destroyed.
TEST_F(ApiMeshes, DestroyedAndReplacedAtTheSameAddressAreSeen) {
  const BatchCollider collider;
  collider.pass(space);
  world.destroy(g1);
  ASSERT_TRUE(soft.replace_at_same_address(make_torus(0.5, 0.2, 12, 8)));
  g1 = world.geom(soft, at(0.7, 0.25, 0.125), space);
  collider.pass(space);
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), right()), "");
  EXPECT_FALSE(collide(g1, g2).empty());
}

TEST_F(ApiMeshes, DestroyedWhileTheirAnswersAreKeptAreNotTouched) {
  const BatchCollider collider;
  collider.pass(space);
  world.destroy(g1);
  world.destroy(soft);
  EXPECT_TRUE(collider.pass(space).order.empty());
  g1 = world.geom(hard, at(0.5, 0.25, 0.125), space);
  EXPECT_GT(collider.pass(space).total(), 0);
}

TEST_F(ApiMeshes, AnnouncedAsDestroyedAreForgotten) {
  const BatchCollider collider;
  collider.pass(space);
  const auto known = collider.stats().meshes;
  const dTriMeshDataID handle = soft.id();
  world.destroy(g1);
  world.destroy(soft);
  dBatchColliderTriMeshDataDestroyed(collider, handle);
  collider.pass(space);
  EXPECT_EQ(collider.stats().meshes, known - 1);
}

TEST_F(ApiMeshes, ThatAreTrustedAreNotRead) {
  const BatchCollider collider(trusting());
  collider.pass(space);
  const Contacts before = collide(g1, g2);
  dent();
  collider.pass(space);
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), before), "");  // as asked for
}

TEST_F(ApiMeshes, ThatAreTrustedAreSeenWhenAnnounced) {
  const BatchCollider collider(trusting());
  collider.pass(space);
  dent();
  dBatchColliderTriMeshDataUpdate(collider, soft.id());
  const Contacts at_once = collide(g1, g2), expected = right();
  collider.pass(space);
  EXPECT_EQ(difference_with_geoms(at_once, expected), "");
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), expected), "");
}

TEST_F(ApiMeshes, ThatAreTrustedMayBeReplacedWhenAnnounced) {
  const BatchCollider collider(trusting());
  collider.pass(space);
  const dTriMeshDataID handle = soft.id();
  world.destroy(g1);
  world.destroy(soft);
  dBatchColliderTriMeshDataDestroyed(collider, handle);
  g1 = world.geom(world.mesh(make_torus(0.5, 0.2, 12, 8)), at(0.7, 0.25, 0.125), space);
  collider.pass(space);
  EXPECT_EQ(difference_with_geoms(collide(g1, g2), right()), "");
}

TEST_F(ApiMeshes, SharedByGeomsAreBuiltOnce) {
  for (int i = 0; i < 5; ++i) world.geom(soft, at(3 + 0.5 * i, 0.1 * i, 0), space);
  const BatchCollider collider;
  EXPECT_GT(collider.pass(space).total(), 0);
  EXPECT_EQ(collider.stats().meshes, 2);
}

// Corners of its own for every triangle, and doubles: what importers hand to ODE.
TEST_F(ApiMeshes, UnweldedAndInDoublesGetTheSameContacts) {
  const Contacts expected = right();
  const TestMesh soup = unshared(soft.mesh());
  const std::vector<double> vertices(soup.vertices.begin(), soup.vertices.end());
  const dTriMeshDataID data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(data, vertices.data(), 3 * sizeof(double), soup.vertex_count(),
                              soup.indices.data(), static_cast<int>(soup.indices.size()),
                              3 * sizeof(unsigned));
  set_mesh(g1, data);
  EXPECT_EQ(difference_with_geoms(right(), expected), "");
  set_mesh(g1, soft.id());
  dGeomTriMeshDataDestroy(data);
}

}  // namespace
}  // namespace ode_ext::test
