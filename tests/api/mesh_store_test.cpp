// SPDX-License-Identifier: BSD-3-Clause
// What the store builds of a mesh that changes; what the answers are then is in meshes_test.cpp.
#include "ode/mesh_store.h"

#include <gtest/gtest.h>

#include <cmath>

#include "ode/answers.h"
#include "support/forged_meshes.h"
#include "support/mesh_makers.h"
#include "support/ode_world.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

int triangles_of(const OdeMesh& mesh) { return mesh.mesh().triangle_count(); }

class MeshStoreTest : public ::testing::Test {
 protected:
  // The mesh in the next pass, after vertex 0 was moved by so much.
  const Mesh& pass(float by = 0) {
    mesh_.edit().vertices[0] += by;
    ++pass_;
    return *store_.refresh(mesh_.id(), triangles_of(mesh_), pass_, pass_);
  }

  OdeWorld world_;
  OdeMesh& mesh_ = world_.mesh(make_icosphere(1, 2));
  MeshStore store_{MeshOptions{}, false};
  std::uint64_t pass_ = 0;
};

TEST_F(MeshStoreTest, BuildsAMeshThatRestsOnce) {
  pass(0.01f);
  const Mesh* built = &pass(0.01f);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(&pass(), built);
}

TEST_F(MeshStoreTest, BuildsEqualContentOnceWhoeverHoldsIt) {
  const OdeMesh& copy = world_.mesh(mesh_.mesh());
  const OdeMesh& other = world_.mesh(make_icosphere(1.5, 2));
  pass();
  EXPECT_EQ(store_.refresh(copy.id(), triangles_of(copy), 1, 1).get(), &pass());
  EXPECT_NE(store_.refresh(other.id(), triangles_of(other), 1, 1).get(), &pass());
  EXPECT_EQ(store_.resident().size(), 2u);
}

TEST_F(MeshStoreTest, ForgetsWhatNoRoundHasMetAndNothingElse) {
  const OdeMesh& other = world_.mesh(make_icosphere(1.5, 2));
  const Mesh* built = &pass();
  store_.refresh(other.id(), triangles_of(other), pass_, pass_);
  EXPECT_EQ(&pass(), built);
  store_.forget_before(pass_);
  EXPECT_EQ(store_.size(), 1u);
  EXPECT_EQ(&pass(), built);
}

TEST_F(MeshStoreTest, DoesNotTakeMeshesOfOneHashForOne) {
  const auto forged = cube_and_plate_of_one_hash();
  for (int i = 0; i < 2; ++i) {
    const OdeMesh& first = world_.mesh(forged[0]);
    const OdeMesh& second = world_.mesh(forged[1]);
    const Mesh* cube = store_.refresh(first.id(), triangles_of(first), 1, 1).get();
    const Mesh* plate = store_.refresh(second.id(), triangles_of(second), 1, 1).get();
    EXPECT_NE(cube, plate);
    EXPECT_EQ(cube->content_hash, plate->content_hash) << "nothing was shown";
  }
  EXPECT_EQ(store_.resident().size(), 2u);
}

TEST_F(MeshStoreTest, KeepsAMeshOfWhichACornerIsNotANumber) {
  store_.set_deformable(mesh_.id(), true);  // else one of equal content would be found again
  const Mesh* before = &pass(NAN);
  EXPECT_FALSE(before->finite);
  EXPECT_EQ(&pass(), before);
}

TEST_F(MeshStoreTest, ReadsAMeshOnceMoreInAPassInWhichAGeomHasOtherTriangles) {
  const Mesh* before = &pass();
  mesh_.rebuild(make_icosphere(1, 1));
  const Mesh* after = store_.refresh(mesh_.id(), triangles_of(mesh_), pass_, pass_).get();
  EXPECT_NE(after, before);
  EXPECT_EQ(after->source.size(), mesh_.mesh().indices.size());
}

TEST_F(MeshStoreTest, MakesRoomByWhatThisPassHasNotMetAndOnlyThenByTheRest) {
  const OdeMesh& old = world_.mesh(make_icosphere(1.5, 2));
  const OdeMesh& moving = world_.mesh(make_icosphere(2, 2));
  store_.set_deformable(moving.id(), true);
  store_.refresh(old.id(), triangles_of(old), 1, 1);
  store_.refresh(moving.id(), triangles_of(moving), 2, 2);
  const Mesh* used = store_.refresh(mesh_.id(), triangles_of(mesh_), 2, 2).get();
  ASSERT_TRUE(store_.make_room({used}, 2));
  EXPECT_EQ(store_.resident().size(), 2u);
  ASSERT_TRUE(store_.make_room({used}, 2));
  ASSERT_EQ(store_.resident().size(), 1u);
  EXPECT_EQ(store_.resident()[0].get(), used);
  EXPECT_FALSE(store_.make_room({used}, 2));
  const Mesh* again = store_.refresh(moving.id(), triangles_of(moving), 3, 3).get();
  EXPECT_TRUE(again->deformable) << "it was forgotten that it deforms";
}

TEST_F(MeshStoreTest, SeesAnEditOfAnyCorner) {
  const Mesh* before = &pass();
  for (std::size_t i = 0; i < mesh_.mesh().vertices.size(); i += 7) {
    float& moved = mesh_.edit().vertices[i];
    moved = std::nextafter(moved, 2.0f);
    const Mesh* after = &pass();
    EXPECT_NE(after, before) << i;
    before = after;
  }
}

// What tells them apart when all else is equal must not be where they are in memory.
TEST(CanonicalOrder, DependsOnTheTrianglesOfMeshesOfOneHash) {
  const auto mesh = [](const TestMesh& made) {
    Mesh built = build_mesh(soup_of(made));
    built.shape_hash = built.content_hash = 1;
    return std::make_shared<const Mesh>(std::move(built));
  };
  PairMember cube, ball;
  cube.mesh = mesh(make_cube(1));
  ball.mesh = mesh(make_icosphere(1, 1));
  const auto before = [](PairMember a, PairMember b, bool a_is_lower) {
    int geoms[2];
    a.geom = reinterpret_cast<dGeomID>(geoms + (a_is_lower ? 0 : 1));
    b.geom = reinterpret_cast<dGeomID>(geoms + (a_is_lower ? 1 : 0));
    return in_canonical_order(a, b);
  };
  EXPECT_EQ(before(cube, ball, true), before(cube, ball, false));
  EXPECT_NE(before(cube, ball, true), before(ball, cube, true));
}

}  // namespace
}  // namespace ode_ext::test
