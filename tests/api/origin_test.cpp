// SPDX-License-Identifier: BSD-3-Clause
// Meshes that are modelled where they lie, as the tiles of a terrain are, with an identity for a
// pose: they give the contacts that they give when modelled about their own origin.
#include <algorithm>
#include <cmath>

#include "support/batch_collider.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

// Hills on a square of 8 m, with two coordinates that can be moved far out without a rounding.
TestMesh hills() {
  TestMesh mesh = make_sheet(8, 16);
  for (std::size_t i = 0; i + 2 < mesh.vertices.size(); i += 3)
    mesh.vertices[i + 2] =
        0.2f * std::sin(1.5f * mesh.vertices[i]) * std::cos(mesh.vertices[i + 1]);
  return mesh;
}

// A coordinate that is given is known to half of its last bit, and depths are given less that.
double unknown(const Point& far) { return 0x1p-24 * (length(far) + 8); }

// What floats make of meshes of a pair that are 3 m together (pair_step.cl).
constexpr double kOfFloats = 3 * 0x1p-20;  // [m]

// Far enough for floats about the origin to be off by centimetres.
const Point kFar[] = {{12288, 0, 0}, {-16384, 8192, 0}, {65536, -65536, 0}};

TEST(ApiOrigin, OfATileDecidesNothing) {
  OdeWorld world;
  const BatchCollider collider;
  const dGeomID rock = world.geom(world.mesh(jittered(make_icosphere(0.5, 2), 0.05, 1)), {});
  const dGeomID here = world.geom(world.mesh(hills()), {});
  for (const Point& far : kFar) {
    const dGeomID there = world.geom(world.mesh(moved(hills(), far)), {});
    Random random(5);
    int compared = 0;
    for (int i = 0; i < 60; ++i) {
      TestPose pose = random.pose(0);
      pose.position = {random.below(7000) * 0x1p-10 - 3, random.below(7000) * 0x1p-10 - 3,
                       random.below(700) * 0x1p-10 + 0.1};
      set_pose(rock, pose);
      const Contacts expected = answer_of(collider, rock, here);
      pose.position = pose.position + far;
      set_pose(rock, pose);
      const Contacts found = answer_of(collider, rock, there);
      ASSERT_EQ(found.size(), expected.size()) << i;
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_LT(distance(pos(found[k]) - far, pos(expected[k])), 1e-11);  // of doubles out there
        EXPECT_EQ(normal(found[k]), normal(expected[k]));
        EXPECT_EQ(found[k].side1, expected[k].side1);
        EXPECT_EQ(found[k].side2, expected[k].side2);
        EXPECT_LE(found[k].depth, expected[k].depth);
        EXPECT_GE(found[k].depth, expected[k].depth - unknown(far));
        ++compared;
      }
    }
    EXPECT_GT(compared, 100);
  }
}

TEST(ApiOrigin, OfABodyDecidesNothingWhereItIsTurned) {
  OdeWorld world;
  const BatchCollider collider;
  const TestMesh torus = jittered(make_torus(0.5, 0.2, 16, 10), 0.01, 2);
  const dGeomID other = world.geom(world.mesh(make_cube(1, 2)), {});
  for (const Point& far : kFar) {
    const TestMesh out = moved(torus, far);
    const TestMesh back = moved(out, -1 * far);  // the same roundings
    const dGeomID there = world.geom(world.mesh(out), {});
    const dGeomID rounded = world.geom(world.mesh(back), {});
    Random random(6);
    int compared = 0;
    for (int i = 0; i < 60; ++i) {
      TestPose pose = random.pose(0.8);
      set_pose(rounded, pose);
      pose.position = pose.position - rotate(pose, far);
      set_pose(there, pose);
      const Contacts expected = answer_of(collider, rounded, other);
      const Contacts found = answer_of(collider, there, other);
      ASSERT_EQ(found.size(), expected.size()) << i;
      if (found.empty()) continue;
      EXPECT_NEAR(found[0].depth, expected[0].depth, unknown(far) + kOfFloats) << i;
      ++compared;
    }
    EXPECT_GT(compared, 20);
  }
}

}  // namespace
}  // namespace ode_ext::test
