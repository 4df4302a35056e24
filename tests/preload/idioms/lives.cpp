// SPDX-License-Identifier: BSD-3-Clause
#include <sys/wait.h>
#include <unistd.h>

#include <memory>

#include "preload/idioms/idioms.h"
#include "preload/idioms/program.h"

namespace idioms {
namespace {

constexpr int kSteps = 4, kBodies = 12;

void near(void* data, dGeomID o1, dGeomID o2) {
  dContactGeom contacts[16];
  const int count = dCollide(o1, o2, 16, contacts, sizeof(dContactGeom));
  static_cast<Log*>(data)->pair(o1, o2, contacts, count);
}

void collide_all(const Bodies& bodies, Log& log) {
  for (std::size_t i = 0; i < bodies.geoms.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.geoms.size(); ++j)
      near(&log, bodies.geoms[i], bodies.geoms[j]);
}

struct World {
  dWorldID world = dWorldCreate();
  dSpaceID space = dHashSpaceCreate(nullptr);
  ~World() {
    dSpaceSetCleanup(space, 0);
    dSpaceDestroy(space);
    dWorldDestroy(world);
  }
};

}  // namespace

std::string without_a_pass() {
  World world;
  const Mesh torus(Mesh::kTorus);
  Bodies bodies;
  for (int i = 0; i < kBodies; ++i) bodies.add(world.world, nullptr, torus);
  Log log;
  Random random(10);
  for (int i = 0; i < kSteps; ++i) {
    bodies.place(random, 4);
    collide_all(bodies, log);
    log.next_step();
  }
  return log.text();
}

// ODE gives the addresses of what is gone to what comes next.
std::string destroyed() {
  World world;
  auto mesh = std::make_unique<Mesh>(Mesh::kTorus);
  Log log;
  {
    Bodies bodies;
    for (int i = 0; i < kBodies; ++i) bodies.add(world.world, world.space, *mesh);
    Random random(11);
    for (int i = 0; i < kSteps; ++i) {
      bodies.place(random, 4);
      space_collide(world.space, &log, &near);
      for (int k = 0; k < 3; ++k) {
        bodies.destroy_first();
        bodies.add(world.world, world.space, *mesh);
      }
      log.next_step();
    }
  }
  mesh.reset();
  mesh = std::make_unique<Mesh>(Mesh::kCube, 2.0f);
  Bodies bodies;
  for (int i = 0; i < kBodies; ++i) bodies.add(world.world, world.space, *mesh);
  Random random(12);
  bodies.place(random, 6);
  space_collide(world.space, &log, &near);
  return log.text();
}

std::string updated() {
  World world;
  Mesh torus(Mesh::kTorus);
  Bodies bodies;
  for (int i = 0; i < kBodies; ++i) bodies.add(world.world, world.space, torus);
  Log log;
  Random random(13);
  bodies.place(random, 4);
  for (const bool by_pass : {false, true})
    for (const float factor : {0.5f, 2.0f}) {
      torus.stretch(factor);
      if (factor < 1)
        dGeomTriMeshDataUpdate(torus.data());
      else
        torus.build();  // what lay outside of the box that ODE knows would be missed
      announce_change(torus.data());
      for (const dGeomID geom : bodies.geoms) dGeomTriMeshSetData(geom, torus.data());
      if (by_pass)
        space_collide(world.space, &log, &near);
      else
        collide_all(bodies, log);
      log.next_step();
    }
  return log.text();
}

std::string reinitialized() {
  std::string text;
  for (int i = 0; i < kSteps; ++i) {
    end();
    dCloseODE();
    dInitODE2(0);
    begin();
    World world;
    const Mesh torus(Mesh::kTorus);
    Bodies bodies;
    for (int k = 0; k < kBodies; ++k) bodies.add(world.world, world.space, torus);
    Random random(14);
    bodies.place(random, 4);
    Log log;
    // In turn, so that either is the first after dInitODE2.
    if (i % 2 == 0)
      space_collide(world.space, &log, &near);
    else
      collide_all(bodies, log);
    text += log.text();
  }
  return text;
}

// A child does not have the device of its parent, and goes on with ODE's own collider.
std::string forked() {
  World world;
  const Mesh torus(Mesh::kTorus);
  Bodies bodies;
  for (int i = 0; i < kBodies; ++i) bodies.add(world.world, world.space, torus);
  Log log;
  Random random(15);
  bodies.place(random, 4);
  space_collide(world.space, &log, &near);

  bodies.place(random, 4);
  int ends[2];
  if (pipe(ends) != 0) fail("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    must_be_sound = false;
    Log of_the_child;
    space_collide(world.space, &of_the_child, &near);
    const std::string& text = of_the_child.text();
    const auto written = write(ends[1], text.data(), text.size());
    _exit(written == static_cast<ssize_t>(text.size()) ? 0 : 1);
  }
  close(ends[1]);
  std::string text;
  char part[4096];
  for (ssize_t count; (count = read(ends[0], part, sizeof(part))) > 0;)
    text.append(part, static_cast<std::size_t>(count));
  close(ends[0]);
  int status = 0;
  if (waitpid(child, &status, 0) != child || status != 0) fail("the child failed");
  space_collide(world.space, &log, &near);
  return text + log.text();
}

}  // namespace idioms
