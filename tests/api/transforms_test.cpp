// SPDX-License-Identifier: BSD-3-Clause
// dGeomTransform: deprecated, still in use, and composed by the gather.
#include "support/batch_collider.h"

// They are deprecated, which is no reason not to test them.
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

namespace ode_ext::test {
namespace {

class ApiTransforms : public ::testing::Test {
 protected:
  // A transform geom around a mesh that is placed in its frame.
  dGeomID transform(const TestPose& shell_pose, const TestPose& mesh_pose, dSpaceID in) {
    const dGeomID shell = world.own(dCreateGeomTransform(in));
    dGeomTransformSetCleanup(shell, 1);
    const dGeomID mesh = dCreateTriMesh(nullptr, torus.id(), nullptr, nullptr, nullptr);
    set_pose(mesh, mesh_pose);
    dGeomTransformSetGeom(shell, mesh);
    set_pose(shell, shell_pose);
    return shell;
  }
  // The same placed directly.
  Contacts direct(const TestPose& first, const TestPose& second) {
    return fresh_answer(world.geom(torus, first), world.geom(torus, second));
  }

  OdeWorld world;
  OdeMesh& torus = world.mesh(make_torus(1, 0.4, 12, 8));
  dSpaceID space = world.space(SpaceKind::Simple);
  // A half turn and dyadic offsets compose without rounding, so bytes can be compared.
  TestPose outer{{0.25, 0.5, 0.125}, {-1, 0, 0, 0, -1, 0, 0, 0, 1}};
  TestPose inner{{0.5, -0.25, 0.0625}, {1, 0, 0, 0, -1, 0, 0, 0, -1}};
};

TEST_F(ApiTransforms, AroundAMeshGetTheContactsOfTheMeshInItsPlace) {
  const dGeomID shell = transform(outer, inner, space);
  const TestPose other = turned({1, 2, 3}, 1, {0.5, 0.25, 0});
  const dGeomID plain = world.geom(torus, other, space);
  const BatchCollider collider;
  Collected collected = collider.pass(space);
  ASSERT_EQ(collected.order.size(), 1u);
  EXPECT_EQ(collider.stats().pairs, 1);
  EXPECT_EQ(collider.stats().pairs_alone, 0);
  const Contacts expected = direct(composed(outer, inner), other);
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(difference(collide(shell, plain), expected), "");
  EXPECT_EQ(difference(collide(plain, shell), flipped(expected)), "");
}

TEST_F(ApiTransforms, TwoOfThemGetTheContactsOfTheirMeshes) {
  const TestPose second{{0.5, 0.0625, 0}, {0, 1, 0, -1, 0, 0, 0, 0, 1}};
  const dGeomID s1 = transform(outer, inner, space), s2 = transform(second, inner, space);
  const BatchCollider collider;
  collider.pass(space);
  EXPECT_EQ(collider.stats().pairs, 1);
  const Contacts expected = direct(composed(outer, inner), composed(second, inner));
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(difference(collide(s1, s2), expected), "");
  EXPECT_EQ(collider.stats().pairs_alone, 0);
}

TEST_F(ApiTransforms, InInfoModeNameTheTransformInTheContacts) {
  const dGeomID shell = transform(outer, inner, space);
  dGeomTransformSetInfo(shell, 1);
  const dGeomID plain = world.geom(torus, {}, space);
  const BatchCollider collider;
  collider.pass(space);
  const Contacts contacts = collide(shell, plain);
  ASSERT_FALSE(contacts.empty());
  for (const dContactGeom& c : contacts) EXPECT_EQ(c.g1, shell);
}

}  // namespace
}  // namespace ode_ext::test
