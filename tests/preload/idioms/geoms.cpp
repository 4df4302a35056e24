// SPDX-License-Identifier: BSD-3-Clause
#include "preload/idioms/idioms.h"
#include "preload/idioms/program.h"

namespace idioms {
namespace {

constexpr int kSteps = 4, kBodies = 10;

void near(void* data, dGeomID o1, dGeomID o2) {
  dContactGeom contacts[16];
  const int count = dCollide(o1, o2, 16, contacts, sizeof(dContactGeom));
  static_cast<Log*>(data)->pair(o1, o2, contacts, count);
}

void destroy(dSpaceID space) {
  dSpaceSetCleanup(space, 0);
  dSpaceDestroy(space);
}

}  // namespace

std::string space_and_geom() {
  const dWorldID world = dWorldCreate();
  const dSpaceID space = dHashSpaceCreate(nullptr);
  Log log;
  {
    const Mesh torus(Mesh::kTorus), cube(Mesh::kCube, 2);
    Bodies in_the_space, alone;
    for (int i = 0; i < kBodies; ++i) in_the_space.add(world, space, torus);
    name(alone.add(world, nullptr, cube), 100);
    Random random(5);
    for (int i = 0; i < kSteps; ++i) {
      in_the_space.place(random, 4);
      alone.place(random, 4);
      const auto as_geom = reinterpret_cast<dGeomID>(space);
      // ODE makes a pass of this by itself.
      dContactGeom contacts[200];
      const int count = dCollide(as_geom, alone.geoms[0], 200, contacts, sizeof(dContactGeom));
      log.pair(as_geom, alone.geoms[0], contacts, count);
      space_collide2(as_geom, alone.geoms[0], &log, &near);
      space_collide2(alone.geoms[0], as_geom, &log, &near);
      log.next_step();
    }
  }
  destroy(space);
  dWorldDestroy(world);
  return log.text();
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"

// With contacts of the geom inside, and with those of the transform.
std::string transform() {
  const dWorldID world = dWorldCreate();
  const dSpaceID space = dHashSpaceCreate(nullptr);
  Log log;
  {
    const Mesh torus(Mesh::kTorus);
    std::vector<dBodyID> bodies;
    for (int i = 0; i < kBodies; ++i) {
      const dGeomID inner = dCreateTriMesh(nullptr, torus.data(), nullptr, nullptr, nullptr);
      dGeomSetPosition(inner, dReal(0.5), 0, dReal(-0.25));
      name(inner, 100 + i);
      const dGeomID outer = dCreateGeomTransform(space);
      dGeomTransformSetGeom(outer, inner);
      dGeomTransformSetCleanup(outer, 1);
      dGeomTransformSetInfo(outer, i % 2);
      name(outer, i);
      bodies.push_back(dBodyCreate(world));
      dGeomSetBody(outer, bodies.back());
    }
    Random random(6);
    for (int i = 0; i < kSteps; ++i) {
      for (const dBodyID body : bodies) place(body, random, 4);
      space_collide(space, &log, &near);
      log.next_step();
    }
    dSpaceDestroy(space);  // with the geoms
  }
  dWorldDestroy(world);
  return log.text();
}

#pragma GCC diagnostic pop

std::string offset() {
  const dWorldID world = dWorldCreate();
  const dSpaceID space = dHashSpaceCreate(nullptr);
  Log log;
  {
    const Mesh torus(Mesh::kTorus);
    Bodies bodies;
    Random random(7);
    dMatrix3 turned;
    dRFromEulerAngles(turned, dReal(0.3), dReal(1.1), dReal(-0.7));
    for (int i = 0; i < kBodies; ++i) {
      const dGeomID geom = bodies.add(world, space, torus);
      dGeomSetOffsetPosition(geom, dReal(0.7), dReal(-0.2), dReal(0.1));
      dGeomSetOffsetRotation(geom, turned);
    }
    for (int i = 0; i < kSteps; ++i) {
      bodies.place(random, 4);
      space_collide(space, &log, &near);
      log.next_step();
    }
  }
  destroy(space);
  dWorldDestroy(world);
  return log.text();
}

// Geoms of one body never meet one another.
std::string many_geoms() {
  const dWorldID world = dWorldCreate();
  const dSpaceID space = dHashSpaceCreate(nullptr);
  Log log;
  {
    const Mesh torus(Mesh::kTorus, 0.5f);
    Bodies bodies;
    for (int i = 0; i < kBodies; ++i) {
      bodies.add(world, space, torus);
      for (int k = 1; k < 4; ++k) {
        const dGeomID more = dCreateTriMesh(space, torus.data(), nullptr, nullptr, nullptr);
        dGeomSetBody(more, bodies.bodies.back());
        dGeomSetOffsetPosition(more, dReal(0.8 * k), 0, 0);
        name(more, 100 * k + i + 1);
      }
    }
    Random random(8);
    for (int i = 0; i < kSteps; ++i) {
      bodies.place(random, 4);
      space_collide(space, &log, &near);
      log.next_step();
    }
    dSpaceDestroy(space);
    bodies.geoms.clear();
  }
  dWorldDestroy(world);
  return log.text();
}

std::string kinds_of_spaces() {
  const dWorldID world = dWorldCreate();
  const dVector3 center = {2, 2, 2}, extents = {4, 4, 4};
  const dSpaceID spaces[] = {dSimpleSpaceCreate(nullptr), dHashSpaceCreate(nullptr),
                             dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ),
                             dQuadTreeSpaceCreate(nullptr, center, extents, 3)};
  Log log;
  const Mesh torus(Mesh::kTorus);
  for (const dSpaceID space : spaces) {
    Bodies bodies;
    for (int i = 0; i < kBodies; ++i) bodies.add(world, space, torus);
    Random random(9);
    for (int i = 0; i < kSteps; ++i) {
      bodies.place(random, 4);
      space_collide(space, &log, &near);
      log.next_step();
    }
  }
  for (const dSpaceID space : spaces) destroy(space);
  dWorldDestroy(world);
  return log.text();
}

}  // namespace idioms
