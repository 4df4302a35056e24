// SPDX-License-Identifier: BSD-3-Clause
// A program of boxes and spheres that fall on a plane: what the preload has nothing to do with, and
// must cost nothing. Prints where they are to the last bit, and how long it took.
#include <ode/ode.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <vector>

#include "support/arguments.h"

namespace {

struct World {
  dWorldID world = dWorldCreate();
  dSpaceID space = dHashSpaceCreate(nullptr);
  dJointGroupID contacts = dJointGroupCreate(0);
  std::vector<dBodyID> bodies;

  explicit World(int count) {
    dWorldSetGravity(world, 0, 0, dReal(-9.81));
    dCreatePlane(space, 0, 0, 1, 0);
    for (int i = 0; i < count; ++i) {
      bodies.push_back(dBodyCreate(world));
      const bool is_box = i % 2 == 0;
      const dGeomID geom = is_box ? dCreateBox(space, dReal(0.4), dReal(0.4), dReal(0.4))
                                  : dCreateSphere(space, dReal(0.25));
      dGeomSetBody(geom, bodies.back());
      dMass mass;
      dMassSetSphere(&mass, 500, dReal(0.25));
      dBodySetMass(bodies.back(), &mass);
      dBodySetPosition(bodies.back(), dReal(0.45 * (i % 10) + 0.01 * (i / 100)),
                       dReal(0.45 * (i / 10 % 10) - 0.01 * (i / 100)),
                       dReal(0.3 + 0.5 * (i / 100)));
    }
  }
  ~World() {
    dJointGroupDestroy(contacts);
    dSpaceDestroy(space);
    dWorldDestroy(world);
  }
};

void near(void* data, dGeomID o1, dGeomID o2) {
  World& world = *static_cast<World*>(data);
  dContact contacts[4] = {};
  const int count = dCollide(o1, o2, 4, &contacts[0].geom, sizeof(dContact));
  for (int i = 0; i < count; ++i) {
    contacts[i].surface.mode = dContactApprox1;
    contacts[i].surface.mu = dReal(0.6);
    const dJointID joint = dJointCreateContact(world.world, world.contacts, &contacts[i]);
    dJointAttach(joint, dGeomGetBody(o1), dGeomGetBody(o2));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Drops boxes and spheres and prints where they come to lie.", "boxes");
  int bodies = 300, steps = 300;
  app.add_option("--bodies", bodies, "How many");
  app.add_option("--steps", steps, "Of a hundredth of a second");
  if (const auto exit_code = parse_arguments(app, argc, argv)) return *exit_code;

  dInitODE2(0);
  double milliseconds = 0;
  {
    World world(bodies);
    for (int i = 0; i < steps; ++i) {
      const auto start = std::chrono::steady_clock::now();
      dSpaceCollide(world.space, &world, &near);
      milliseconds +=
          std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
              .count();
      dWorldQuickStep(world.world, dReal(0.01));
      dJointGroupEmpty(world.contacts);
    }
    for (const dBodyID body : world.bodies) {
      const dReal* p = dBodyGetPosition(body);
      std::printf("state: %a %a %a\n", p[0], p[1], p[2]);
    }
  }
  dCloseODE();
  std::printf("figures: %.4f ms a pass\n", milliseconds / steps);
  return 0;
}
