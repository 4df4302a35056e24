// SPDX-License-Identifier: BSD-3-Clause
// Bodies that touch all around, as threads do: no plane separates them as a whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "makers/thread.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

TestMesh test_mesh(const falling_objects::TriangleMesh& mesh) {
  return {{mesh.vertices.begin(), mesh.vertices.end()}, {mesh.indices.begin(), mesh.indices.end()}};
}

// A nut on its bolt, 3 mm from it everywhere, is moved and turned from there. The way back parts
// them, so nothing of either has farther to go than that.
class NutOnBolt : public ::testing::Test {
 protected:
  static constexpr double kPitch = 0.1, kRadius = 0.103, kHeight = 0.34;

  double deepest(const Point& moved, double tilt) {
    TestPose pose = turned({1, 0, 0}, tilt);
    pose.position = {moved[0], moved[1], 4 * kPitch + moved[2]};
    set_pose(nut, pose);
    double depth = -1;
    for (const dContactGeom& c : answer_of(collider, bolt, nut))
      depth = std::max(depth, static_cast<double>(c.depth));
    return depth;
  }

  OdeWorld world;
  const BatchCollider collider;
  const falling_objects::Thread thread = {0.1, 0.075, kPitch, 48, 6};
  const dGeomID bolt =
      world.geom(world.mesh(test_mesh(falling_objects::make_bolt(thread, 0.2, 0.1))), {});
  const dGeomID nut = world.geom(
      world.mesh(test_mesh(falling_objects::make_nut({0.1, 0.075, kPitch, 48, 2}, 0.003, 0.2))),
      {});
};

TEST_F(NutOnBolt, HasNoContactsWithinItsPlay) { EXPECT_EQ(deepest({0, 0, 0}, 0), -1); }

TEST_F(NutOnBolt, IsNoDeeperBeyondItsPlayThanTheWayBack) {
  const struct {
    Point moved;  // [m]
    double tilt;  // [rad]
  } cases[] = {{{0, 0, -0.004}, 0},
               {{0, 0, -0.005}, 0},
               {{0.005, 0, 0}, 0},
               {{0.005, 0.0003, 0.0001}, 0},
               {{0.001, 0.006, 0.0001}, 0.001},
               {{0.004, 0, -0.004}, 0},
               {{0, 0, -0.002}, 0.02},
               {{0.0015, 0.001, -0.0032}, 0.004}};
  for (const auto& [moved, tilt] : cases) {
    const double depth = deepest(moved, tilt);
    EXPECT_GT(depth, 0);
    // Turning takes a point at most as far as the tilt times its distance from the axis.
    EXPECT_LT(depth, length(moved) + std::fabs(tilt) * std::hypot(kRadius, kHeight))
        << moved[0] << ' ' << moved[1] << ' ' << moved[2] << ", tilted by " << tilt;
  }
}

}  // namespace
}  // namespace ode_ext::test
