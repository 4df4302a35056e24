// SPDX-License-Identifier: BSD-3-Clause
// Open surfaces against solid bodies: what goes through a ground comes back, and what a patch
// touches is pushed nowhere else.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

class ApiOpenTarget : public ::testing::Test {
 protected:
  // The deepest contact that pushes `body` up; 0: there is none.
  static double pushed_up(dGeomID body, dGeomID ground) {
    double deepest = 0;
    for (const dContactGeom& c : collide(body, ground))
      if (normal(c)[2] > 0.5) deepest = std::max(deepest, double{c.depth});
    return deepest;
  }

  OdeWorld world;
  BatchCollider collider;
};

// Of a square in its own plane.
double distance_to_sheet(const Point& local, double size) {
  const auto clamped = [&](double x) { return std::clamp(x, -0.5 * size, 0.5 * size); };
  return distance(local, {clamped(local[0]), clamped(local[1]), 0});
}

// Its lowest edge is 0.1 m below the top of the ball, wherever it faces.
TEST_F(ApiOpenTarget, APatchThatDipsIntoABallTouchesItThereOnly) {
  constexpr double kDip = 0.1;
  for (const double size : {0.1, 0.6})
    for (const double radius : {0.5, 1.0, 2.0, 5.0}) {
      const dGeomID ball = world.geom(world.mesh(make_icosphere(radius, 3)), {});
      const dGeomID patch = world.geom(world.mesh(make_sheet(size, 4)), {});
      // What dips in is within the cap of this half width; the ball's faces there lean by the sine
      // half_width / radius, and one of them parts the patch from the ball by this at most.
      const double half_width = std::sqrt(2 * kDip * radius - kDip * kDip);
      const double across = std::min(2 * half_width, std::numbers::sqrt2 * size);
      const double deepest = kDip + across * half_width / radius;
      for (int tilt = 0; tilt < 360; tilt += 10)
        for (int turn = 0; turn < 360; turn += 60) {
          SCOPED_TRACE(testing::Message() << "patch of " << size << ", ball of " << radius
                                          << ", tilt " << tilt << ", turn " << turn);
          const double angle = tilt * std::numbers::pi / 180;
          const double lowest = -0.5 * size * std::fabs(std::sin(angle));
          const TestPose pose = composed(
              turned({0, 0, 1}, turn * std::numbers::pi / 180, {0, 0, radius - kDip - lowest}),
              turned({1, 0, 0}, angle));
          set_pose(patch, pose);
          const Contacts contacts = collide(patch, ball);
          EXPECT_FALSE(contacts.empty());
          for (const dContactGeom& c : contacts) {
            EXPECT_LE(distance_to_sheet(to_local(pose, pos(c)), size), 1.1 * kDip);
            EXPECT_LE(c.depth, deepest);
          }
        }
    }
}

// Its middle is above the ground, below it, or it is all but gone.
TEST_F(ApiOpenTarget, AGroundPushesABallUpByAsMuchAsItSank) {
  const dGeomID ground = world.geom(world.mesh(make_sheet(8, 16)), {});
  const dGeomID ball = world.geom(world.mesh(make_icosphere(0.5, 3)), {});
  for (const double sunk : {0.001, 0.1, 0.5, 0.7, 0.95}) {
    set_pose(ball, at(0.123, 0.456, 0.5 - sunk));
    EXPECT_NEAR(pushed_up(ball, ground), sunk, 0.02) << sunk;  // the ball's faces are 0.15 m wide
  }
}

// A car and its engine, a tower of blocks, a bar through a ball: the way through each goes past the
// walls of its parts.
TEST_F(ApiOpenTarget, AGroundPushesABodyUpOfWhichPartsAreInOneAnother) {
  const dGeomID ground = world.geom(world.mesh(make_sheet(8, 1)), {});
  const TestMesh car = merged(make_cube(1), make_icosphere(0.3, 2));
  const TestMesh tower =
      merged(moved(make_cube(0.5), {0, 0, -0.25}), moved(make_cube(0.5), {0, 0, 0.25}));
  const TestMesh barbell = merged(make_box({1, 1, 1}), make_box({2, 0.2, 0.2}));
  for (const TestMesh& mesh : {car, tower, barbell})
    for (const bool deformable : {false, true}) {
      const OdeMesh& body = world.mesh(mesh);
      dBatchColliderTriMeshDataSetDeformable(collider, body.id(), deformable ? 1 : 0);
      const dGeomID geom = world.geom(body, {});
      for (const double sunk : {0.01, 0.1, 0.3}) {
        set_pose(geom, at(0.123, 0.234, 0.5 - sunk));
        EXPECT_NEAR(pushed_up(geom, ground), sunk, 1e-4)
            << mesh.triangle_count() << " triangles, deformable " << deformable;
      }
    }
}

TEST_F(ApiOpenTarget, AGroundPushesAPlankUpThatLiesAcrossItsBorder) {
  const dGeomID ground = world.geom(world.mesh(make_sheet(8, 16)), {});
  const dGeomID plank = world.geom(world.mesh(make_box({2, 1, 0.1}, 16, 8, 1)), {});
  for (const double over : {0.25, 0.5, 0.75})  // of its length, beyond the border
    for (const double sunk : {0.01, 0.04, 0.06, 0.09}) {
      set_pose(plank, turned({0.3, 0.5, 0.7}, 0.01, {4 + 2 * (over - 0.5), 0.123, 0.05 - sunk}));
      EXPECT_NEAR(pushed_up(plank, ground), sunk, 0.01) << over << " over, " << sunk << " m deep";
    }
}

}  // namespace
}  // namespace ode_ext::test
