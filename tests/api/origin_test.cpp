// SPDX-License-Identifier: BSD-3-Clause
// Meshes that are modelled where they lie, as the tiles of a terrain are, with an identity for a
// pose: they give the contacts that they give when modelled about their own origin.
#include <algorithm>
#include <cmath>
#include <vector>

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

// Which is taken a little larger, and in whose frame a pair is computed, goes by what they hash to.
bool comes_first(const TestMesh& a, const TestMesh& b) {
  return build_mesh(soup_of(a)).shape_hash < build_mesh(soup_of(b)).shape_hash;
}

// The ground about its origin, with something beside it by which a pair with the body is in the
// order in which it has `large`.
TestMesh alike(const TestMesh& ground, const TestMesh& large, const TestMesh& body) {
  TestMesh mesh = ground;
  for (double away = 3; comes_first(mesh, body) != comes_first(large, body); ++away)
    mesh = merged(ground, moved(make_tetrahedron(0.1), {0.01 * away, 0, -3}));
  return mesh;
}

// A body, the ground that it meets, and how high above it.
struct GroundCase {
  TestMesh body, ground;
  double low, high;  // [m]
};

std::vector<GroundCase> ground_cases() {
  const TestMesh rock = jittered(make_icosphere(0.5, 2), 0.05, 1);
  const TestMesh torus = jittered(make_torus(0.4, 0.15, 16, 10), 0.01, 2);
  const TestMesh slab = jittered(make_box({8, 8, 1}, 16, 16, 1), 0.05, 3);  // its top is at 0.5
  return {{rock, make_waves(8, 16), 0.1, 0.7},
          {torus, make_waves(8, 16), 0.1, 0.5},
          {rock, slab, 0.9, 1.05},
          {torus, slab, 0.75, 0.95},
          {jittered(make_tetrahedron(0.3), 0.01, 4), slab, -0.1, 0.1}};  // within
}

// The other case: its origin is where it is for something that lies as far out beyond.
TEST(ApiOrigin, OfALargeMeshDecidesNothing) {
  int in_order[2] = {0, 0};
  for (const auto& [body_mesh, ground_mesh, low, high] : ground_cases())
    for (const Point& far : kFar) {
      OdeWorld world;
      // All of them: which are kept of more is for a bit to decide.
      const BatchCollider collider([](dBatchColliderParams& params) { params.max_contacts = 64; });
      const TestMesh large = far_out(ground_mesh, far);
      const TestMesh rounded = moved(moved(ground_mesh, far), -1 * far);  // as it is there
      ++in_order[comes_first(large, body_mesh) ? 0 : 1];
      const dGeomID body = world.geom(world.mesh(body_mesh), {});
      const dGeomID here = world.geom(world.mesh(alike(rounded, large, body_mesh)), {});
      const dGeomID there = world.geom(world.mesh(large), {});
      Random random(7);
      int compared = 0, others = 0;
      for (int i = 0; i < 100; ++i) {
        TestPose ground = random.pose(0.5);
        if (i % 2 == 0) ground.rotation = TestPose{}.rotation;
        TestPose pose = random.pose(0);
        pose.position = {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(low, high)};
        set_pose(body, composed(ground, pose));
        set_pose(here, ground);
        ground.position = ground.position - rotate(ground, far);
        set_pose(there, ground);
        const Contacts expected = answer_of(collider, body, here);
        const Contacts found = answer_of(collider, body, there);
        EXPECT_EQ(found.empty(), expected.empty()) << i;
        if (found.size() < expected.size())
          others += static_cast<int>(expected.size() - found.size());
        for (const dContactGeom& c : found) {
          const bool is_known = std::any_of(expected.begin(), expected.end(), [&](const auto& e) {
            return distance(pos(c), pos(e)) < 1e-4 && distance(normal(c), normal(e)) < 1e-4 &&
                   std::fabs(c.depth - e.depth) < kOfFloats + unknown(far);
          });
          if (!is_known) ++others;  // planes as good as each other to within epsilon
          ++compared;
        }
      }
      EXPECT_GT(compared, 200);
      EXPECT_LE(10 * others, compared);
    }
  EXPECT_GT(in_order[0], 2);
  EXPECT_GT(in_order[1], 2);
}

}  // namespace
}  // namespace ode_ext::test
