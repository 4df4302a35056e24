// SPDX-License-Identifier: BSD-3-Clause
// dBatchColliderGetMeshlets: in which cluster of triangles each of a mesh is.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

class ApiMeshlets : public ::testing::Test {
 protected:
  // As a pass would.
  void meet(const OdeMesh& mesh) {
    answer_of(collider, world.geom(mesh, {}), world.geom(ball, at(0.5, 0, 0)));
  }
  std::vector<int> ask(const OdeMesh& mesh, int count) {
    std::vector<int> meshlets(static_cast<std::size_t>(count), 7);
    found = dBatchColliderGetMeshlets(collider, mesh.id(), count, meshlets.data());
    return meshlets;
  }
  static bool all_unknown(const std::vector<int>& meshlets) {
    return std::all_of(meshlets.begin(), meshlets.end(), [](int m) { return m == -1; });
  }

  OdeWorld world;
  BatchCollider collider;
  const OdeMesh& ball = world.mesh(make_icosphere(0.5, 3));
  const int triangles = ball.mesh().triangle_count();
  int found = -2;
};

TEST_F(ApiMeshlets, HoldEveryTriangleAndNoMoreThanSixteenEach) {
  for (const bool deformable : {false, true}) {
    dBatchColliderTriMeshDataSetDeformable(collider, ball.id(), deformable);
    meet(ball);
    const std::vector<int> meshlets = ask(ball, triangles);
    EXPECT_GE(found, triangles / 16);
    EXPECT_LT(found, triangles / 4);
    std::vector<int> sizes(static_cast<std::size_t>(found));
    for (const int meshlet : meshlets) ++sizes.at(static_cast<std::size_t>(meshlet));
    EXPECT_LE(*std::max_element(sizes.begin(), sizes.end()), 16);
    EXPECT_GT(*std::min_element(sizes.begin(), sizes.end()), 0);
  }
}

// Of a ball of 1,280 triangles sixteen in one place reach over a small part.
TEST_F(ApiMeshlets, AreOfTrianglesNearOneAnother) {
  meet(ball);
  const std::vector<int> meshlets = ask(ball, triangles);
  const TestMesh& mesh = ball.mesh();
  const auto corner = [&](std::size_t triangle) { return mesh.corner(triangle, 0); };
  for (std::size_t i = 0; i < meshlets.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      if (meshlets[i] != meshlets[j]) continue;
      EXPECT_LT(distance(corner(i), corner(j)), 0.5);
    }
}

TEST_F(ApiMeshlets, AreNoneOfTrianglesWithTwoCornersInOnePlace) {
  TestMesh mesh = make_cube(1, 2);
  mesh.indices.insert(mesh.indices.end(), {0, 0, 1});
  const OdeMesh& cube = world.mesh(mesh);
  meet(cube);
  const std::vector<int> meshlets = ask(cube, mesh.triangle_count());
  EXPECT_GT(found, 0);
  EXPECT_EQ(meshlets.back(), -1);
  EXPECT_EQ(std::count(meshlets.begin(), meshlets.end(), -1), 1);
}

TEST_F(ApiMeshlets, AreUnknownOfMeshesThatWereNotMetOrAreAsTheyWereNot) {
  EXPECT_TRUE(all_unknown(ask(ball, triangles)));
  EXPECT_EQ(found, 0);
  meet(ball);
  EXPECT_TRUE(all_unknown(ask(ball, triangles - 1)));
  EXPECT_EQ(found, 0);
  dBatchColliderTriMeshDataUpdate(collider, ball.id());
  EXPECT_TRUE(all_unknown(ask(ball, triangles)));
  EXPECT_EQ(found, 0);
  meet(ball);
  ask(ball, triangles);
  EXPECT_GT(found, 0);
  std::vector<int> meshlets(1, 7);
  EXPECT_EQ(dBatchColliderGetMeshlets(nullptr, ball.id(), 1, meshlets.data()), 0);
  EXPECT_EQ(meshlets[0], -1);
}

TEST_F(ApiMeshlets, RefuseWhatCannotBe) {
  int meshlet = 7;
  EXPECT_EQ(dBatchColliderGetMeshlets(collider, nullptr, 1, &meshlet), -1);
  EXPECT_EQ(last_error(), "dBatchColliderGetMeshlets: the mesh is NULL");
  EXPECT_EQ(dBatchColliderGetMeshlets(collider, ball.id(), -1, &meshlet), -1);
  EXPECT_EQ(last_error(), "dBatchColliderGetMeshlets: triangle_count is -1");
  EXPECT_EQ(dBatchColliderGetMeshlets(collider, ball.id(), 1, nullptr), -1);
  EXPECT_EQ(last_error(), "dBatchColliderGetMeshlets: meshlets is NULL");
  EXPECT_EQ(meshlet, 7);
}

}  // namespace
}  // namespace ode_ext::test
