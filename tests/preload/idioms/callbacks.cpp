// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include "preload/idioms/idioms.h"
#include "preload/idioms/program.h"

namespace idioms {
namespace {

constexpr int kSteps = 4, kBodies = 14;
constexpr double kExtent = 4;  // [m]

// A world with bodies in one space, collided step by step.
struct Scene {
  dWorldID world = dWorldCreate();
  dSpaceID space = dHashSpaceCreate(nullptr);
  Mesh torus{Mesh::kTorus};
  std::unique_ptr<Bodies> all = std::make_unique<Bodies>();
  Bodies& bodies = *all;
  Log log;

  Scene() {
    for (int i = 0; i < kBodies; ++i) bodies.add(world, space, torus);
  }
  ~Scene() {
    all.reset();
    dSpaceDestroy(space);
    dWorldDestroy(world);
  }

  std::string run(dNearCallback* callback) {
    Random random(1);
    for (int i = 0; i < kSteps; ++i) {
      bodies.place(random, kExtent);
      space_collide(space, &log, callback);
      log.next_step();
    }
    return log.text();
  }
};

Log& log_of(void* data) { return *static_cast<Log*>(data); }

}  // namespace

std::string in_the_callback() {
  Scene scene;
  return scene.run([](void* data, dGeomID o1, dGeomID o2) {
    dContact contacts[8];
    const int count = dCollide(o1, o2, 8, &contacts[0].geom, sizeof(dContact));
    log_of(data).pair(o1, o2, &contacts[0].geom, count, sizeof(dContact));
  });
}

// A space of spaces, and the callback that every program with those has: across two geoms where
// one of them is a space, then inside of each.
namespace {

struct Spaces {
  Scene scene;
  dSpaceID inner[2], innermost;

  Spaces() {
    inner[0] = dSimpleSpaceCreate(scene.space);
    inner[1] = dHashSpaceCreate(scene.space);
    innermost = dSimpleSpaceCreate(inner[1]);
    const dSpaceID places[] = {inner[0], inner[1], innermost};
    for (std::size_t i = 0; i < scene.bodies.geoms.size(); ++i) {
      if (i % 4 == 3) continue;  // stays in the outer one
      dSpaceRemove(scene.space, scene.bodies.geoms[i]);
      dSpaceAdd(places[i % 4], scene.bodies.geoms[i]);
    }
  }
};

template <class Meet>
void recurse(dGeomID o1, dGeomID o2, void* data, dNearCallback* callback, Meet meet) {
  if (!dGeomIsSpace(o1) && !dGeomIsSpace(o2)) return meet();
  space_collide2(o1, o2, data, callback);
  for (const dGeomID geom : {o1, o2})
    if (dGeomIsSpace(geom)) space_collide(reinterpret_cast<dSpaceID>(geom), data, callback);
}

void near_recursive(void* data, dGeomID o1, dGeomID o2) {
  recurse(o1, o2, data, &near_recursive, [&] {
    dContactGeom contacts[16];
    log_of(data).pair(o1, o2, contacts, dCollide(o1, o2, 16, contacts, sizeof(dContactGeom)));
  });
}

}  // namespace

std::string recursion() {
  Spaces spaces;
  return spaces.scene.run(&near_recursive);
}

namespace {

using Pairs = std::vector<std::pair<dGeomID, dGeomID>>;

void near_recording(void* data, dGeomID o1, dGeomID o2) {
  recurse(o1, o2, data, &near_recording, [&] { static_cast<Pairs*>(data)->emplace_back(o1, o2); });
}

}  // namespace

std::string recorded() {
  Spaces spaces;
  Scene& scene = spaces.scene;
  Random random(2);
  for (int i = 0; i < kSteps; ++i) {
    scene.bodies.place(random, kExtent);
    Pairs pairs;
    space_collide(scene.space, &pairs, &near_recording);
    for (const auto& [o1, o2] : pairs) {
      static dContactGeom contacts[250];
      const int count = dCollide(o1, o2, 250, contacts, sizeof(dContactGeom));
      scene.log.pair(o1, o2, contacts, count);
    }
    scene.log.next_step();
  }
  return scene.log.text();
}

namespace {

bool same_contacts(const dContactGeom* a, const dContactGeom* b, int count) {
  return std::memcmp(a, b, static_cast<std::size_t>(count) * sizeof(dContactGeom)) == 0;
}

bool mirrored(const dContactGeom& a, const dContactGeom& b) {
  for (int k = 0; k < 3; ++k)
    if (a.pos[k] != b.pos[k] || a.normal[k] != -b.normal[k]) return false;
  return a.depth == b.depth && a.g1 == b.g2 && a.g2 == b.g1 && a.side1 == b.side2 &&
         a.side2 == b.side1;
}

}  // namespace

std::string twice_and_swapped() {
  Scene scene;
  return scene.run([](void* data, dGeomID o1, dGeomID o2) {
    dContactGeom first[100] = {}, again[100] = {}, swapped[100] = {};
    const int count = dCollide(o1, o2, 100, first, sizeof(dContactGeom));
    const int count_again = dCollide(o1, o2, 100, again, sizeof(dContactGeom));
    const int count_swapped = dCollide(o2, o1, 100, swapped, sizeof(dContactGeom));
    log_of(data).pair(o1, o2, first, count);
    log_of(data).pair(o2, o1, swapped, count_swapped);
    if (count != count_again || !same_contacts(first, again, count))
      fail("the same question has two answers");
    if (must_be_sound &&
        (count != count_swapped || !std::equal(first, first + count, swapped, &mirrored)))
      fail("exchanged geoms do not exchange contacts");
  });
}

namespace {

struct Detection {
  Log* log;
  int found = 0;
};

void near_until_found(void* data, dGeomID o1, dGeomID o2) {
  auto& detection = *static_cast<Detection*>(data);
  if (detection.found != 0) return;
  static dContactGeom contacts[250];
  const int count = dCollide(o1, o2, 250, contacts, sizeof(dContactGeom));
  detection.log->pair(o1, o2, contacts, count);
  detection.found += count;
}

}  // namespace

std::string early_exit() {
  Scene scene;
  Random random(3);
  for (int i = 0; i < kSteps; ++i) {
    scene.bodies.place(random, kExtent);
    Detection detection{&scene.log};
    space_collide(scene.space, &detection, &near_until_found);
    scene.log.next_step();
  }
  return scene.log.text();
}

namespace {

struct Entry {
  double before;
  dContact contact;
  int after[5];
};

}  // namespace

std::string prefilled() {
  Scene scene;
  return scene.run([](void* data, dGeomID o1, dGeomID o2) {
    constexpr int kMost = 6;
    Entry entries[kMost], untouched[kMost];
    std::memset(entries, 0x5a, sizeof(entries));
    std::memcpy(untouched, entries, sizeof(entries));
    const int count = dCollide(o1, o2, kMost, &entries[0].contact.geom, sizeof(Entry));
    log_of(data).pair(o1, o2, &entries[0].contact.geom, count, sizeof(Entry));
    for (int i = 0; i < count; ++i)
      std::memcpy(&untouched[i].contact.geom, &entries[i].contact.geom, sizeof(dContactGeom));
    // ODE's own collider writes beyond what it returns where it drops a contact again.
    if (must_be_sound && std::memcmp(entries, untouched, sizeof(entries)) != 0)
      fail("something beside the contacts was written");
  });
}

// A simple space looks at each geom when it comes to it.
std::string disabled() {
  Scene scene;
  const dSpaceID simple = dSimpleSpaceCreate(nullptr);
  for (const dGeomID geom : scene.bodies.geoms) {
    dSpaceRemove(scene.space, geom);
    dSpaceAdd(simple, geom);
  }
  Random random(4);
  for (int i = 0; i < kSteps; ++i) {
    for (const dGeomID geom : scene.bodies.geoms) dGeomEnable(geom);
    scene.bodies.place(random, kExtent);
    space_collide(simple, &scene.log, [](void* data, dGeomID o1, dGeomID o2) {
      dContactGeom contacts[16];
      const int count = dCollide(o1, o2, 16, contacts, sizeof(dContactGeom));
      log_of(data).pair(o1, o2, contacts, count);
      if (count > 0) dGeomDisable(o2);
    });
    scene.log.next_step();
  }
  scene.all.reset();
  dSpaceDestroy(simple);
  return scene.log.text();
}

}  // namespace idioms
