// SPDX-License-Identifier: BSD-3-Clause
// Bodies that a program puts exactly on one another, in ODE's own steps.
#include <gtest/gtest.h>

#include "support/attach_contacts.h"
#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

constexpr double kSide = 0.2;  // [m]

struct Stack {
  explicit Stack(int count) {
    dWorldSetGravity(id, 0, 0, -9.81);
    boxes.push_back(world.geom(world.mesh(make_box({4, 4, 1})), at(0, 0, -0.5)));
    for (int i = 0; i < count; ++i) {
      const dGeomID box = world.geom(world.mesh(make_cube(kSide)), {});
      const dBodyID body = dBodyCreate(id);
      dMass mass;
      dMassSetBoxTotal(&mass, 1, kSide, kSide, kSide);
      dBodySetMass(body, &mass);
      dGeomSetBody(box, body);
      dBodySetPosition(body, 0, 0, (i + 0.5) * kSide);
      boxes.push_back(box);
    }
  }
  ~Stack() {
    for (std::size_t i = 1; i < boxes.size(); ++i) {
      const dBodyID body = dGeomGetBody(boxes[i]);
      dGeomSetBody(boxes[i], nullptr);
      dBodyDestroy(body);
    }
    dJointGroupDestroy(joints);
    dWorldDestroy(id);
  }
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;

  void step(double seconds, int (*solver)(dWorldID, dReal) = &dWorldStep) {
    for (std::size_t i = 0; i < boxes.size(); ++i)
      for (std::size_t k = i + 1; k < boxes.size(); ++k)
        attach_contacts(id, joints, answer_of(collider, boxes[i], boxes[k]));
    solver(id, seconds);
    dJointGroupEmpty(joints);
  }

  OdeWorld world;
  BatchCollider collider;
  dWorldID id = dWorldCreate();
  dJointGroupID joints = dJointGroupCreate(0);
  std::vector<dGeomID> boxes;
};

// Where two that fall as one touched at no depth, dWorldStep found no solution: they fell through
// the floor, and came out of it at metres a second.
TEST(ApiStack, OfBoxesWithoutGapsStands) {
  for (const double hz : {60.0, 240.0})
    for (const int count : {2, 3, 6}) {
      Stack stack(count);
      for (int i = 0; i < hz / 2; ++i) stack.step(1 / hz);
      for (int i = 0; i < count; ++i)
        EXPECT_NEAR(dGeomGetPosition(stack.boxes[static_cast<std::size_t>(i) + 1])[2],
                    (i + 0.5) * kSide, 1e-3)
            << count << " at " << hz << " Hz";
    }
}

// ODE's solver undoes what bodies are in one another to the last nanometre, and what rounding then
// lifts off has no contact, so that it falls for a step. A surface layer is never undone.
TEST(ApiStack, OfTwoBoxesDoesNotDropWhereContactsHaveASurfaceLayer) {
  for (const double hz : {60.0, 240.0}) {
    const double fall = 9.81 / hz;  // [m/s] of one step
    Stack stack(2);
    dWorldSetContactSurfaceLayer(stack.id, 1e-3);
    for (int i = 0; i < 10 * hz; ++i) {
      stack.step(1 / hz, &dWorldQuickStep);
      for (const dGeomID box : {stack.boxes[1], stack.boxes[2]})
        ASSERT_GT(dBodyGetLinearVel(dGeomGetBody(box))[2], -0.9 * fall) << i << " at " << hz;
    }
  }
}

}  // namespace
}  // namespace ode_ext::test
