// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <thread>

#include "preload/idioms/idioms.h"
#include "preload/idioms/program.h"

namespace idioms {
namespace {

constexpr int kWorlds = 3, kSteps = 6, kBodies = 10;

struct World {
  dWorldID world = dWorldCreate();
  dSpaceID space = dHashSpaceCreate(nullptr);
  Mesh torus{Mesh::kTorus};
  std::unique_ptr<Bodies> bodies = std::make_unique<Bodies>();
  Random random;
  Log log;

  explicit World(int number) : random(static_cast<std::uint32_t>(20 + number)) {
    for (int i = 0; i < kBodies; ++i) bodies->add(world, space, torus);
  }
  ~World() {
    bodies.reset();
    dSpaceDestroy(space);
    dWorldDestroy(world);
  }

  void step() {
    bodies->place(random, 4);
    space_collide(space, &log, [](void* data, dGeomID o1, dGeomID o2) {
      dContactGeom contacts[16];
      const int count = dCollide(o1, o2, 16, contacts, sizeof(dContactGeom));
      static_cast<Log*>(data)->pair(o1, o2, contacts, count);
    });
    log.next_step();
  }
};

std::string text_of(const std::vector<std::unique_ptr<World>>& worlds) {
  std::string text;
  for (const auto& world : worlds) text += world->log.text();
  return text;
}

std::vector<std::unique_ptr<World>> some_worlds() {
  std::vector<std::unique_ptr<World>> worlds;
  for (int i = 0; i < kWorlds; ++i) worlds.push_back(std::make_unique<World>(i));
  return worlds;
}

}  // namespace

std::string worlds() {
  const auto all = some_worlds();
  for (int i = 0; i < kSteps; ++i)
    for (const auto& world : all) world->step();
  return text_of(all);
}

std::string threads() {
  const auto all = some_worlds();
  std::vector<std::thread> running;
  for (const auto& world : all) {
    running.emplace_back([&world] {
      dAllocateODEDataForThread(dAllocateMaskAll);
      begin();
      for (int i = 0; i < kSteps; ++i) world->step();
      end();
    });
    if (!must_be_sound) running.back().join();
  }
  for (std::thread& thread : running)
    if (thread.joinable()) thread.join();
  return text_of(all);
}

}  // namespace idioms
