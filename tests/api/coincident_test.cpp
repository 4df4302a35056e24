// SPDX-License-Identifier: BSD-3-Clause
// A mesh on its own copy: nothing but the handles tells the two apart. And solid and open meshes
// that have the same surface.
#include <gtest/gtest.h>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

class ApiCoincident : public testing::Test {
 protected:
  OdeWorld world_;
  dSpaceID space_ = world_.space(SpaceKind::Simple);
  const OdeMesh& mesh_ = world_.mesh(make_l(1));
  const TestPose pose_ = turned({1, 2, 3}, 0.5, {1, 2, 3});
  const dGeomID g1_ = world_.geom(mesh_, pose_, space_);
  const dGeomID g2_ = world_.geom(mesh_, pose_, space_);
};

TEST_F(ApiCoincident, CopiesHaveContacts) { EXPECT_FALSE(fresh_answer(g1_, g2_).empty()); }

TEST_F(ApiCoincident, CopiesHaveContactsByRaysOfAllVertices) {
  const OdeMesh& box = world_.mesh(make_cube(1));
  for (const TestPose& pose : {TestPose{}, pose_})
    EXPECT_FALSE(fresh_answer(world_.geom(box, pose, space_), world_.geom(box, pose, space_), 64,
                              with("rays=iterative"))
                     .empty());
  EXPECT_FALSE(fresh_answer(g1_, g2_, 64, with("rays=iterative")).empty());
}

TEST_F(ApiCoincident, CopiesAreAnsweredAlikeAloneAndInABatchAndInBothOrders) {
  Contacts in_a_batch;
  {
    const BatchCollider collider;
    collider.pass(space_);
    in_a_batch = collide(g1_, g2_);
  }
  EXPECT_EQ(difference(fresh_answer(g1_, g2_), in_a_batch), "");
  EXPECT_EQ(difference(flipped(fresh_answer(g2_, g1_)), in_a_batch), "");
  const BatchCollider collider;  // asked before any pass, through the override
  EXPECT_EQ(difference(flipped(collide(g2_, g1_)), in_a_batch), "");
}

TestMesh without_triangle(TestMesh mesh, int triangle) {
  const auto begin = mesh.indices.begin() + 3 * triangle;
  mesh.indices.erase(begin, begin + 3);
  return mesh;
}

class ApiCoincidentOpen : public testing::Test {
 protected:
  // The second lies `above` the first, along its own z [m].
  Contacts answer(const TestMesh& first, const TestMesh& second, double above = 0) {
    const TestPose pose = turned({1, 2, 3}, 0.5, {1, 2, 3});
    const dSpaceID space = world_.space(SpaceKind::Simple);
    return fresh_answer(world_.geom(world_.mesh(first), pose, space),
                        world_.geom(world_.mesh(second), composed(pose, at(0, 0, above)), space));
  }

  OdeWorld world_;
};

TEST_F(ApiCoincidentOpen, CopiesOfABoxWithAHoleHaveContactsWhereverTheHoleIs) {
  const TestMesh box = make_box({1, 2, 3});
  for (int k = 0; k < box.triangle_count(); ++k) {
    const TestMesh open = without_triangle(box, k);
    EXPECT_FALSE(answer(open, open).empty()) << "without triangle " << k;
  }
}

TEST_F(ApiCoincidentOpen, ABoxWithAHoleAndTheBoxHaveContactsInEitherOrder) {
  const TestMesh box = make_box({1, 2, 3});
  for (int k = 0; k < box.triangle_count(); ++k) {
    const TestMesh open = without_triangle(box, k);
    EXPECT_FALSE(answer(open, box).empty()) << "without triangle " << k;
    EXPECT_FALSE(answer(box, open).empty()) << "without triangle " << k;
  }
}

TEST_F(ApiCoincidentOpen, CopiesOfFinerOpenMeshesHaveContacts) {
  for (const TestMesh& mesh :
       {make_icosphere(1, 2), make_torus(1, 0.3, 16, 8), make_cube(1, 4), make_l(1)}) {
    const TestMesh open = without_triangle(mesh, mesh.triangle_count() / 2);
    EXPECT_FALSE(answer(open, open).empty()) << mesh.triangle_count() << " triangles";
  }
}

TEST_F(ApiCoincidentOpen, CopiesOfSeveralOpenPartsHaveContacts) {
  const TestMesh open = without_triangle(make_cube(1), 3);
  const TestMesh parts = merged(open, moved(open, {3, 0, 0}));
  EXPECT_FALSE(answer(parts, parts).empty());
}

TEST_F(ApiCoincidentOpen, CopiesOfASheetHaveContacts) {
  for (const TestMesh& mesh : {make_triangle(1), make_sheet(1, 4), make_waves(4, 8)})
    EXPECT_FALSE(answer(mesh, mesh).empty()) << mesh.triangle_count() << " triangles";
}

TEST_F(ApiCoincidentOpen, SheetsThatDoNotQuiteTouchHaveNone) {
  for (const double above : {1e-4, -1e-4})
    for (const TestMesh& mesh : {make_triangle(1), make_sheet(1, 4), make_waves(4, 8)})
      EXPECT_TRUE(answer(mesh, mesh, above).empty()) << mesh.triangle_count() << " triangles";
}

TEST_F(ApiCoincidentOpen, CopiesAreNoDeeperThanTheLeastWayOut) {
  const TestMesh box = make_box({1, 2, 3});
  for (int k = 0; k < box.triangle_count(); ++k) {
    const TestMesh open = without_triangle(box, k);
    for (const dContactGeom& c : answer(open, open)) EXPECT_LE(c.depth, 1 + 1e-4) << k;
  }
}

}  // namespace
}  // namespace ode_ext::test
