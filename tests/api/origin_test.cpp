// SPDX-License-Identifier: BSD-3-Clause
// Meshes that are modelled where they lie, as the tiles of a terrain are, with an identity for a
// pose: they give the contacts that they give when modelled about their own origin.
#include <algorithm>
#include <cmath>

#include "support/batch_collider.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

// A coordinate that is given is known to half of its last bit, and depths are given less that.
double unknown(const Point& far) { return 0x1p-24 * (length(far) + 8); }

// What floats make of meshes of a pair that are 10 m together (pair_step.cl).
constexpr double kOfFloats = 10 * 0x1p-20;  // [m]

// Far enough for floats about the origin to be off by centimetres.
const Point kFar[] = {{12288, 0, 0}, {-16384, 8192, 0}, {65536, -65536, 0}};

TEST(ApiOrigin, OfATileDecidesNothing) {
  OdeWorld world;
  const BatchCollider collider;
  const dGeomID rock = world.geom(world.mesh(jittered(make_icosphere(0.5, 2), 0.05, 1)), {});
  const dGeomID here = world.geom(world.mesh(make_waves(8, 16)), {});
  for (const Point& far : kFar) {
    const dGeomID there = world.geom(world.mesh(moved(make_waves(8, 16), far)), {});
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

// Waves about their origin that a pair with the body has in the order in which it has `large`: that
// goes by what meshes hash to, and says which of them is taken a little larger.
TestMesh waves_alike(const TestMesh& large, const TestMesh& body) {
  const auto comes_first = [&](const TestMesh& mesh) {
    return build_mesh(soup_of(mesh)).shape_hash < build_mesh(soup_of(body)).shape_hash;
  };
  TestMesh waves = make_waves(8, 16);
  for (double away = 3; comes_first(waves) != comes_first(large); ++away)
    waves = merged(make_waves(8, 16), moved(make_tetrahedron(0.1), {0.01 * away, 0, -3}));
  return waves;
}

// The other case: its origin is where it is for something that lies as far out beyond.
TEST(ApiOrigin, OfALargeMeshDecidesNothing) {
  OdeWorld world;
  const BatchCollider collider;
  const TestMesh body_mesh = jittered(make_icosphere(0.5, 2), 0.05, 1);
  const dGeomID rock = world.geom(world.mesh(body_mesh), {});
  for (const Point& far : kFar) {
    const TestMesh large = far_out(make_waves(8, 16), far);
    const dGeomID here = world.geom(world.mesh(waves_alike(large, body_mesh)), {});
    const dGeomID there = world.geom(world.mesh(large), {});
    Random random(7);
    int compared = 0, others = 0;
    for (int i = 0; i < 120; ++i) {
      TestPose ground = random.pose(0.5);
      if (i % 2 == 0) ground.rotation = TestPose{}.rotation;
      TestPose body = random.pose(0);
      body.position = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(0.1, 0.7)};
      set_pose(rock, composed(ground, body));
      set_pose(here, ground);
      ground.position = ground.position - rotate(ground, far);
      set_pose(there, ground);
      const Contacts expected = answer_of(collider, rock, here);
      const Contacts found = answer_of(collider, rock, there);
      EXPECT_EQ(found.size(), expected.size()) << i;
      for (const dContactGeom& c : found) {
        const bool is_known = std::any_of(expected.begin(), expected.end(), [&](const auto& e) {
          return distance(pos(c), pos(e)) < kOfFloats + unknown(far) &&
                 distance(normal(c), normal(e)) < 1e-4 &&
                 std::fabs(c.depth - e.depth) < kOfFloats + unknown(far);
        });
        if (!is_known) ++others;  // as good, as floats have it
        ++compared;
      }
    }
    EXPECT_GT(compared, 1000);
    EXPECT_LT(100 * others, compared);
  }
}

}  // namespace
}  // namespace ode_ext::test
