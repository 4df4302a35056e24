// SPDX-License-Identifier: BSD-3-Clause
// Bodies of one layer that fall in a room of one layer, in ODE's own steps.
#include <gtest/gtest.h>

#include "support/attach_contacts.h"
#include "support/batch_collider.h"
#include "support/convex_makers.h"

namespace ode_ext::test {
namespace {

constexpr double kHz = 100;

struct Fall {
  explicit Fall(Random& random) {
    dWorldSetGravity(id, 0, 0, -9.81);
    dMass mass;
    dMassSetSphereTotal(&mass, 1, 0.2);
    dBodySetMass(body, &mass);
    dGeomSetBody(cone, body);
    TestPose pose = random.pose(0.05);
    pose.position[2] += 0.85;
    set_pose(cone, pose);
    const Point turning = 2.0 * random.direction();
    dBodySetAngularVel(body, turning[0], turning[1], turning[2]);
  }
  ~Fall() {
    dGeomSetBody(cone, nullptr);
    dBodyDestroy(body);
    dJointGroupDestroy(joints);
    dWorldDestroy(id);
  }
  Fall(const Fall&) = delete;
  Fall& operator=(const Fall&) = delete;

  void step() {
    attach_contacts(id, joints, answer_of(collider, room, cone, 16));
    dWorldStep(id, 1 / kHz);
    dJointGroupEmpty(joints);
  }

  OdeWorld world;
  BatchCollider collider;
  dWorldID id = dWorldCreate();
  dJointGroupID joints = dJointGroupCreate(0);
  dBodyID body = dBodyCreate(id);
  dGeomID room = world.geom(world.mesh(inverted(opened(make_box({4, 4, 3}), 1.5))), at(0, 0, 1.5));
  dGeomID cone = world.geom(world.mesh(opened(make_cone(0.2, 0.3, 16), -0.15)), {});
};

// Where they are cleared unit by unit, as bowls in their like are, a cone that has gone into the
// floor by its rim has one contact of no depth there, swings about that and falls through: 3 of 24.
TEST(ApiOpenRoom, HoldsConesThatFallOnItsFloor) {
  Random random(3);
  for (int i = 0; i < 24; ++i) {
    Fall fall(random);
    for (int step = 0; step < 1.5 * kHz; ++step) fall.step();
    EXPECT_GT(dGeomGetPosition(fall.cone)[2], 0) << i;
  }
}

}  // namespace
}  // namespace ode_ext::test
