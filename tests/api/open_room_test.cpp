// SPDX-License-Identifier: BSD-3-Clause
// Bodies of one layer that fall in a room of one layer, in ODE's own steps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/attach_contacts.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

constexpr double kHz = 100;

// A box without its lid that looks in, its floor at 0.
TestMesh make_room() {
  TestMesh box = inverted(moved(make_box({4, 4, 3}), {0, 0, 1.5}));
  TestMesh room{box.vertices, {}};
  for (std::size_t i = 0; i < box.indices.size(); i += 3) {
    const auto is_high = [&](std::size_t k) { return box.vertex(box.indices[i + k])[2] > 1.5; };
    if (is_high(0) && is_high(1) && is_high(2)) continue;
    for (std::size_t k = 0; k < 3; ++k) room.indices.push_back(box.indices[i + k]);
  }
  return room;
}

// Without its base, its front outside.
TestMesh make_open_cone(double radius, double height, unsigned sides) {
  TestMesh cone{{0, 0, static_cast<float>(height / 2)}, {}};
  for (unsigned i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    for (const double v : {radius * std::cos(angle), radius * std::sin(angle), -height / 2})
      cone.vertices.push_back(static_cast<float>(v));
    cone.indices.insert(cone.indices.end(), {0, 1 + i, 1 + (i + 1) % sides});
  }
  return cone;
}

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
  dGeomID room = world.geom(world.mesh(make_room()), {});
  dGeomID cone = world.geom(world.mesh(make_open_cone(0.2, 0.3, 16)), {});
};

// Where they are cleared unit by unit, as bowls in their like are, a cone that has gone into the
// floor by its rim has one contact of no depth there, swings about that and falls through: 4 of 24.
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
