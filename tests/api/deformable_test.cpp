// SPDX-License-Identifier: BSD-3-Clause
// Deformable meshes give what they would give had they just been built in their shape.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

class ApiDeformable : public ::testing::Test {
 public:
  // ODE's box of a mesh holds all shapes it will take: it is built with two vertices far out.
  OdeMesh& boxed(const TestMesh& mesh) {
    TestMesh wide = mesh;
    for (std::size_t k = 0; k < 3; ++k) wide.vertices[k] = -2, wide.vertices[3 + k] = 2;
    OdeMesh& made = world.mesh(wide);
    std::copy(mesh.vertices.begin(), mesh.vertices.end(), made.edit().vertices.begin());
    return made;
  }
  // Bends the mesh from its form `rest`, irregularly, so that no two contacts tie.
  static void put(OdeMesh& mesh, const TestMesh& rest, double time) {
    auto& vertices = mesh.edit().vertices;
    for (std::size_t i = 0; i < vertices.size(); i += 3) {
      const double x = rest.vertices[i], y = rest.vertices[i + 1], z = rest.vertices[i + 2];
      vertices[i] = static_cast<float>(x + 0.04 * std::sin(7 * y + time) + 0.01 * std::sin(97 * z));
      vertices[i + 1] = static_cast<float>(y + 0.05 * std::cos(5 * z + 3 * x + time));
      vertices[i + 2] = static_cast<float>(z + 0.1 * std::sin(4 * x + time) * std::cos(3 * y) +
                                           0.01 * std::sin(113 * x + 71 * y));
    }
    dGeomTriMeshDataUpdate(mesh.id());
  }
  void put(OdeMesh& mesh, double time) { put(mesh, rests.at(&mesh), time); }

  // The answer of a collider that never saw the meshes in another shape.
  Contacts fresh(dGeomID o1, dGeomID o2, int most = 0) const {
    const BatchCollider collider([&](auto& p) { p.max_contacts_deformable = most; });
    announce(collider);
    Contacts contacts(64);
    const dGeomID pair[] = {o1, o2};
    int count = 0;
    EXPECT_GE(dBatchColliderCollidePairs(collider, pair, 1, 64, contacts.data(),
                                         sizeof(dContactGeom), &count),
              0)
        << last_error();
    contacts.resize(static_cast<std::size_t>(count));
    return contacts;
  }
  void announce(const BatchCollider& collider) const {
    for (const auto& [mesh, rest] : rests)
      dBatchColliderTriMeshDataSetDeformable(collider, mesh->id(), 1);
  }
  OdeMesh& soft(TestMesh mesh) {
    OdeMesh& made = boxed(mesh);
    rests.emplace(&made, std::move(mesh));
    put(made, 0);
    return made;
  }

  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Simple);
  std::map<OdeMesh*, TestMesh> rests;
  OdeMesh& hull = soft(make_icosphere(0.6, 3));
  OdeMesh& cloth = soft(make_sheet(1.6, 20));
  OdeMesh& hard = world.mesh(make_cube(0.8, 3));
  dGeomID g_hull = world.geom(hull, turned({1, 2, 3}, 1, {0.5, 0.25, 0.6}), space);
  dGeomID g_cloth = world.geom(cloth, turned({2, 1, 0}, 0.1, {0, 0, 0.3}), space);
  dGeomID g_hard = world.geom(hard, {}, space);

  void expect_fresh() const {
    for (const GeomPair& pair :
         {GeomPair{g_hull, g_hard}, GeomPair{g_cloth, g_hard}, GeomPair{g_hull, g_cloth}}) {
      const Contacts contacts = collide(pair.first, pair.second);
      EXPECT_FALSE(contacts.empty());
      EXPECT_EQ(difference_with_geoms(contacts, fresh(pair.first, pair.second)), "");
    }
  }
};

TEST_F(ApiDeformable, MeshesThatMoveGiveWhatFreshOnesGive) {
  const BatchCollider collider;
  announce(collider);
  std::vector<Contacts> answers;
  for (int step = 0; step < 5; ++step) {
    SCOPED_TRACE(step);
    put(hull, 0.3 * step);
    put(cloth, 0.2 * step);
    collider.pass(space);
    EXPECT_EQ(collider.stats().deformed, step == 0 ? 0 : 2);
    EXPECT_GT(collider.stats().ms[dBatchStageDeformStep], 0);
    EXPECT_EQ(collider.stats().pairs_alone, 0);
    expect_fresh();
    answers.push_back(collide(g_cloth, g_hard));
    for (int i = 0; i < step; ++i) EXPECT_NE(difference(answers.back(), answers[i]), "");
  }
}

// Whatever is as good as something else: the triangles of a face, edges that a sheet is pierced by,
// planes of two faces. The mesh is first met in a shape that is cut into other meshlets.
TEST_F(ApiDeformable, MeshesWhoseContactsTieGiveWhatFreshOnesGive) {
  const std::pair<TestMesh, TestPose> softs[] = {
      {make_cube(0.8, 4), at(0.7, 0, 0.7)},      {make_cube(0.8, 4), at(0.7, 0.7, 0.7)},
      {make_cube(0.8, 4), at(0.1, 0.2, 0.79)},   {make_cube(0.8, 4), at(0.8, 0, 0.8)},
      {make_sheet(1.6, 2), at(0.03, 0.02, 0.1)}, {make_icosphere(0.5, 2), at(0, 0, 0)}};
  const dGeomID pillar = world.geom(world.mesh(make_box({0.3, 0.3, 3})), {}, space);
  std::size_t contacts = 0;
  for (const auto& [mesh, pose] : softs) {
    OdeMesh& made = soft(mesh);
    const dGeomID geom = world.geom(made, pose, space);
    for (const int most : {0, 4}) {
      const BatchCollider collider([&](auto& p) { p.max_contacts_deformable = most; });
      announce(collider);
      auto& vertices = made.edit().vertices;
      for (std::size_t i = 0; i < vertices.size(); i += 3) {
        const float x = mesh.vertices[i], y = mesh.vertices[i + 1], z = mesh.vertices[i + 2];
        vertices[i] = 0.4f * z + 0.3f * y * y;
        vertices[i + 1] = 2.2f * x;
        vertices[i + 2] = 0.7f * y - 0.6f * x * z;
      }
      collider.pass(space);
      vertices = mesh.vertices;
      collider.pass(space);
      EXPECT_GT(collider.stats().deformed, 0);
      for (const dGeomID other : {g_hard, pillar}) {
        const Contacts answer = collide(geom, other);
        contacts += answer.size();
        EXPECT_EQ(difference_with_geoms(answer, fresh(geom, other, most)), "")
            << mesh.triangle_count() << " triangles, at most " << most;
      }
    }
  }
  EXPECT_GT(contacts, 200u);
}

TEST_F(ApiDeformable, AMeshThatIsShutIsASolidWhateverItWas) {
  const TestMesh shut = unshared(make_cube(0.5, 2));
  OdeMesh& box = soft(shut);
  const dGeomID geom = world.geom(box, {}, space);  // wholly inside of the hard cube
  const BatchCollider collider;
  announce(collider);
  auto& vertices = box.edit().vertices;
  vertices = shut.vertices;
  vertices[2] += 0.05f;  // a corner of one triangle
  collider.pass(space);
  const Contacts open = collide(geom, g_hard);
  vertices = shut.vertices;
  collider.pass(space);
  const Contacts answer = collide(geom, g_hard);
  EXPECT_NE(difference(answer, open), "");
  EXPECT_EQ(difference_with_geoms(answer, fresh(geom, g_hard)), "");
}

TEST_F(ApiDeformable, MeshesThatRestCostNothing) {
  const BatchCollider collider;
  announce(collider);
  collider.pass(space);
  put(cloth, 1);
  collider.pass(space);
  EXPECT_EQ(collider.stats().deformed, 1);
  collider.pass(space);
  EXPECT_EQ(collider.stats().deformed, 0);
  EXPECT_EQ(collider.stats().pairs_computed, 0);
  expect_fresh();
}

TEST_F(ApiDeformable, MeshesAreSeenAtOnceWhereAnnounced) {
  const BatchCollider collider([](dBatchColliderParams& p) { p.trust_meshes = 1; });
  announce(collider);
  collider.pass(space);
  const Contacts before = collide(g_cloth, g_hard);
  put(cloth, 1);
  collider.pass(space);
  EXPECT_EQ(difference(collide(g_cloth, g_hard), before), "");  // trusted, and not announced
  dBatchColliderTriMeshDataUpdate(collider, cloth.id());
  EXPECT_NE(difference(collide(g_cloth, g_hard), before), "");
  expect_fresh();
}

TEST_F(ApiDeformable, TrianglesAppearAndVanish) {
  const BatchCollider collider;
  announce(collider);
  collider.pass(space);
  const TestMesh whole = rests.at(&cloth);
  TestMesh part = whole;
  part.indices.resize(part.indices.size() / 2);
  int step = 0;
  for (const TestMesh& mesh : {part, whole, part}) {
    SCOPED_TRACE(step++);
    cloth.rebuild(mesh);
    put(cloth, whole, 0.3 * step);
    set_mesh(g_cloth, cloth.id());
    collider.pass(space);
    expect_fresh();
    put(cloth, whole, 0.3 * step + 0.1);
    collider.pass(space);
    expect_fresh();
  }
}

// In place, without a word to ODE: the same number of triangles, one of them folded up.
TEST_F(ApiDeformable, TrianglesCollapseAndComeBackUnannounced) {
  const BatchCollider collider;
  announce(collider);
  collider.pass(space);
  auto& indices = cloth.edit().indices;
  const auto all = indices;
  for (std::size_t i = 0; i < indices.size() / 2; i += 3) indices[i + 1] = indices[i];
  put(cloth, 0.2);
  collider.pass(space);
  expect_fresh();
  std::copy(all.begin(), all.end(), indices.begin());
  put(cloth, 0.4);
  collider.pass(space);
  expect_fresh();
}

TEST_F(ApiDeformable, AMeshIsOneOnlyWhileDeclaredSo) {
  const BatchCollider collider;
  collider.pass(space);
  const Contacts rigid = collide(g_cloth, g_hard);
  EXPECT_EQ(difference_with_geoms(rigid, fresh_answer(g_cloth, g_hard)), "");
  put(cloth, 0.5);
  collider.pass(space);
  EXPECT_EQ(collider.stats().deformed, 0);
  EXPECT_EQ(difference_with_geoms(collide(g_cloth, g_hard), fresh_answer(g_cloth, g_hard)), "");
  announce(collider);
  collider.pass(space);
  expect_fresh();
  put(cloth, 1);
  collider.pass(space);
  expect_fresh();
  for (const auto& [mesh, rest] : rests)
    dBatchColliderTriMeshDataSetDeformable(collider, mesh->id(), 0);
  put(cloth, 0);
  collider.pass(space);
  EXPECT_EQ(collider.stats().deformed, 0);
  EXPECT_EQ(difference_with_geoms(collide(g_cloth, g_hard), rigid), "");
}

TEST_F(ApiDeformable, MeshesOfEqualContentGoTheirOwnWays) {
  OdeMesh& twin = soft(rests.at(&cloth));
  OdeMesh& rigid = boxed(rests.at(&cloth));
  put(rigid, rests.at(&cloth), 0);
  const dGeomID g_twin = world.geom(twin, turned({2, 1, 0}, 0.1, {0, 0, 0.3}), space);
  const dGeomID g_rigid = world.geom(rigid, turned({2, 1, 0}, 0.1, {0, 0, 0.3}), space);
  const BatchCollider collider;
  announce(collider);
  collider.pass(space);
  const Contacts of_rigid = collide(g_rigid, g_hard);
  EXPECT_EQ(difference_with_geoms(of_rigid, fresh_answer(g_rigid, g_hard)), "");
  EXPECT_EQ(difference(collide(g_twin, g_hard), collide(g_cloth, g_hard)), "");
  put(cloth, 0.7);
  collider.pass(space);
  expect_fresh();
  EXPECT_NE(difference(collide(g_twin, g_hard), collide(g_cloth, g_hard)), "");
  EXPECT_EQ(difference_with_geoms(collide(g_twin, g_hard), fresh(g_twin, g_hard)), "");
  EXPECT_EQ(difference_with_geoms(collide(g_rigid, g_hard), of_rigid), "");
  put(twin, 0.7);
  collider.pass(space);
  EXPECT_EQ(difference(collide(g_twin, g_hard), collide(g_cloth, g_hard)), "");
}

TEST_F(ApiDeformable, MeshesComeAndGoWhileOthersMove) {
  const BatchCollider collider;
  announce(collider);
  collider.pass(space);
  put(cloth, 0.3);
  OdeMesh& guest = world.mesh(make_torus(0.5, 0.2, 12, 8));
  const dGeomID g_guest = world.geom(guest, at(-0.5, 0, 0.2), space);
  collider.pass(space);
  expect_fresh();
  put(cloth, 0.6);
  const dTriMeshDataID handle = guest.id();
  world.destroy(g_guest);
  world.destroy(guest);
  dBatchColliderTriMeshDataDestroyed(collider, handle);
  collider.pass(space);
  EXPECT_EQ(collider.stats().meshes, 3);
  expect_fresh();
}

// Meshes that nothing comes near are forgotten after 6,000 passes, but not what was declared of
// them.
TEST_F(ApiDeformable, AMeshIsStillOneAfterItWasOutOfSightForLong) {
  const BatchCollider collider;
  announce(collider);
  collider.pass(space);
  dSpaceRemove(space, g_cloth);
  for (int i = 0; i < 6100; ++i) collider.pass(space);
  EXPECT_EQ(collider.stats().pairs, 1);
  dSpaceAdd(space, g_cloth);
  collider.pass(space);
  expect_fresh();
  put(cloth, 1);
  collider.pass(space);
  EXPECT_EQ(collider.stats().deformed, 1);
  expect_fresh();
}

TEST_F(ApiDeformable, AMeshThatIsNotFiniteForAWhileComesBack) {
  const BatchCollider collider;
  announce(collider);
  collider.pass(space);
  cloth.edit().vertices[7] = std::numeric_limits<float>::quiet_NaN();
  collider.pass(space);
  EXPECT_TRUE(collide(g_cloth, g_hard).empty());
  EXPECT_EQ(collider.stats().status, unsigned{dBatchStatusMeshRefused});
  put(cloth, 0.3);
  collider.pass(space);
  EXPECT_EQ(collider.stats().status, 0u);
  expect_fresh();
}

TEST_F(ApiDeformable, AMeshThatLeavesItsBoxIsReported) {
  const BatchCollider collider;
  announce(collider);
  collider.pass(space);
  EXPECT_EQ(collider.stats().status, 0u);
  float& coordinate = cloth.edit().vertices[4];
  coordinate = 2;  // on the box
  collider.pass(space);
  EXPECT_EQ(collider.stats().status, 0u);
  coordinate = std::nextafter(std::nextafter(2.0f, 3.0f), 3.0f);
  collider.pass(space);
  EXPECT_EQ(collider.stats().status, unsigned{dBatchStatusMeshLeftBox});
  collider.pass(space);  // and it is still outside
  EXPECT_EQ(collider.stats().status, unsigned{dBatchStatusMeshLeftBox});
  coordinate = -1;
  collider.pass(space);
  EXPECT_EQ(collider.stats().status, 0u);
}

TEST_F(ApiDeformable, RigidMeshesEditedInPlaceMayLeaveTheirBoxToo) {
  const BatchCollider collider;
  collider.pass(space);
  hard.edit().vertices[0] *= 1.25f;
  collider.pass(space);
  EXPECT_EQ(collider.stats().status, unsigned{dBatchStatusMeshLeftBox});
}

// All of them, or as many as the program keeps.
TEST_F(ApiDeformable, PairsKeepAsManyContactsAsTheProgramSays) {
  const auto contacts_of = [&](int most) {
    const BatchCollider collider(
        [&](dBatchColliderParams& params) { params.max_contacts_deformable = most; });
    announce(collider);
    return answer_of(collider, g_hull, g_cloth, 1000);
  };
  const Contacts all = contacts_of(0), some = contacts_of(5);
  ASSERT_GT(all.size(), 64u);
  EXPECT_EQ(some.size(), 5u);
}

}  // namespace
}  // namespace ode_ext::test
