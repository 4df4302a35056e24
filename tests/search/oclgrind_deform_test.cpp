// SPDX-License-Identifier: BSD-3-Clause
// The deform step small enough for Oclgrind: see oclgrind_test.cpp.
#include <gtest/gtest.h>

#include "support/deform_rig.h"

namespace ode_ext::test {
namespace {

TEST(OclgrindDeform, FollowsAnOpenAndAClosedMesh) {
  DeformRig rig;
  TriangleSoup sheet = strip(20), ball = soup_of(make_icosphere(0.6, 1));
  const auto open = deformable(sheet), closed = deformable(ball);
  rig.set({open, closed});
  const auto closed_shape = deformed(closed, bent(ball));
  rig.set({open, closed_shape});
  EXPECT_GT(rig.read(1).mesh.moved, 0);
  rig.set({deformed(open, bent(sheet)), closed_shape});  // one moves, the other rests
  EXPECT_GT(rig.read(0).mesh.moved, 0);
  EXPECT_EQ(rig.read(1).mesh.moved, 0);
  for (const ox_vertex& vertex : rig.read(1).vertices) EXPECT_LT(vertex.exit, 1.5f);
}

// Two faces that cancel out, and one without area.
TEST(OclgrindDeform, FollowsATwoSidedAndAFlatTriangle) {
  const Vec3f a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, far{2, 0, 0};
  DeformRig rig;
  rig.set({deformable({a, b, c, a, c, far, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}})});
  int without_normal = 0;
  for (const ox_vertex& vertex : rig.read(0).vertices)
    without_normal += vec(vertex.direction) == Vec3f{};
  EXPECT_EQ(without_normal, 3);
}

}  // namespace
}  // namespace ode_ext::test
