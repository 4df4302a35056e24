// SPDX-License-Identifier: BSD-3-Clause
// Bodies of one layer that fall in rooms and on grounds of one layer, in ODE's own steps.
#include <gtest/gtest.h>

#include "support/attach_contacts.h"
#include "support/batch_collider.h"
#include "support/convex_makers.h"

namespace ode_ext::test {
namespace {

constexpr double kHz = 100;

struct Fall {
  Fall(const TestMesh& ground_mesh, double up, const TestMesh& mesh, Random& random)
      : ground(world.geom(world.mesh(ground_mesh), at(0, 0, up))),
        falling(world.geom(world.mesh(mesh), {})) {
    dWorldSetGravity(id, 0, 0, -9.81);
    dMass mass;
    dMassSetSphereTotal(&mass, 1, 0.2);
    dBodySetMass(body, &mass);
    dGeomSetBody(falling, body);
    TestPose pose = random.pose(0.05);
    pose.position[2] += 0.85;
    set_pose(falling, pose);
    const Point turning = 2.0 * random.direction();
    dBodySetAngularVel(body, turning[0], turning[1], turning[2]);
  }
  ~Fall() {
    dGeomSetBody(falling, nullptr);
    dBodyDestroy(body);
    dJointGroupDestroy(joints);
    dWorldDestroy(id);
  }
  Fall(const Fall&) = delete;
  Fall& operator=(const Fall&) = delete;

  void step() {
    attach_contacts(id, joints, answer_of(collider, ground, falling, 16));
    dWorldStep(id, 1 / kHz);
    dJointGroupEmpty(joints);
  }

  OdeWorld world;
  BatchCollider collider;
  dWorldID id = dWorldCreate();
  dJointGroupID joints = dJointGroupCreate(0);
  dBodyID body = dBodyCreate(id);
  dGeomID ground, falling;
};

// Where they are cleared unit by unit, as bowls in their like are, a cone that has gone into the
// floor by its rim has one contact of no depth there, swings about that and falls through: 3 of 24.
TEST(ApiOpenRoom, HoldsConesThatFallOnItsFloor) {
  const TestMesh room = inverted(opened(make_box({4, 4, 3}), 1.5));
  const TestMesh cone = opened(make_cone(0.2, 0.3, 16), -0.15);
  Random random(3);
  for (int i = 0; i < 24; ++i) {
    Fall fall(room, 1.5, cone, random);
    for (int step = 0; step < 1.5 * kHz; ++step) fall.step();
    EXPECT_GT(dGeomGetPosition(fall.falling)[2], 0) << i;
  }
}

// A plate has no thickness that would still cross the ground when it has come to lie on it: 12 of
// these 24 fell through, now the 3 that turn on their way through, and are below from end to end
// after one step, by 1.3 to 4 cm. The ground goes down at a corner: of one that is flat all over
// the box is flat, and ODE's spaces pair nothing with it that is below.
TEST(ApiOpenGround, HoldsMostPlatesOfOneLayer) {
  TestMesh ground = make_sheet(8, 8);
  ground.vertices[2] = -1;
  Random random(4);
  int fallen = 0;
  for (int i = 0; i < 24; ++i) {
    Fall fall(ground, 0, make_sheet(0.35, 4), random);
    for (int step = 0; step < 2 * kHz; ++step) fall.step();
    fallen += dGeomGetPosition(fall.falling)[2] < -0.1;
  }
  EXPECT_LE(fallen, 3);
}

}  // namespace
}  // namespace ode_ext::test
