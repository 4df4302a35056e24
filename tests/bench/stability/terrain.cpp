// SPDX-License-Identifier: BSD-3-Clause
// Stones come to rest on hills, wherever these lie in the frame of their mesh: about its origin, as
// a tile far from it, or far out in a mesh that is as large.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bench/stability/bench.h"
#include "bench/stability/trials.h"
#include "support/test_scene.h"

namespace ode_ext::stability {
namespace {

constexpr double kHz = 60;
constexpr double kSettled = 8, kEnd = 10;  // [s]
constexpr double kSize = 24;               // [m]

struct Terrain {
  std::string name;
  double far = 0;  // [m] along x and y
  Shape shape;
};

struct Rest {
  double mean_speed = 0, fastest = 0;  // [m/s] from 8 s on
  double contacts = 0;                 // of a stone, the mean
  int lost = 0;
};

std::vector<Terrain> make_terrains() {
  const TestMesh hills = make_waves(kSize, 96);
  std::vector<Terrain> terrains{{"about its origin", 0, {hills, {}}}};
  for (const double far : {1024.0, 8192.0}) {
    const std::string name = std::to_string(static_cast<int>(far)) + " m out";
    const Point there{far, far, 0};
    terrains.push_back({name + ", alone", far, {moved(hills, there), {}}});
    terrains.push_back({name + " in a large mesh", far, {far_out(hills, there), {}}});
  }
  return terrains;
}

Rest run(const Terrain& terrain, Collider collider, const TrialOptions& options) {
  Random random(options.seed);  // the same stones for all
  const Shape stone = solid_shape(jittered(make_icosphere(0.4, 2), 0.06, 1));
  Bench bench({.collider = collider,
               .hz = kHz,
               .max_contacts = options.max_contacts,
               .seed = options.seed});
  bench.add_fixed(terrain.shape, TestPose{}, 0);
  const int rows = options.quick ? 3 : 8;
  std::vector<dBodyID> stones;
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < rows; ++k) {
      TestPose pose = random.pose(0);
      const double step = 0.8 * kSize / rows;
      pose.position = {terrain.far + step * (i - 0.5 * (rows - 1)),
                       terrain.far + step * (k - 0.5 * (rows - 1)), 0.8};
      stones.push_back(bench.add_body(stone, pose, 0));
    }
  while (bench.time() < kSettled) bench.step();
  Rest rest;
  int steps = 0;
  for (; bench.time() < kEnd; ++steps) {
    bench.step();
    for (const dBodyID body : stones) {
      const double speed = length(velocity(body));
      rest.mean_speed += speed / static_cast<double>(stones.size());
      rest.fastest = std::max(rest.fastest, speed);
    }
    rest.contacts += bench.contacts(0) / static_cast<double>(stones.size());
  }
  rest.mean_speed /= steps;
  rest.contacts /= steps;
  rest.lost = static_cast<int>(std::count_if(
      stones.begin(), stones.end(), [](dBodyID body) { return position(body)[2] < -0.5; }));
  return rest;
}

}  // namespace

void run_terrain(const TrialOptions& options, Report& report) {
  report.note(
      "terrain: 64 stones of 320 triangles (9 with --quick) dropped from 0.4 m onto hills of "
      "18,432 triangles, at 60 Hz.\nFrom 8 s to 10 s.");
  std::vector<Row> rows;
  Rest about_origin;
  bool is_same = true, is_held = true;
  for (const Terrain& terrain : make_terrains())
    for (const Collider collider : kMeshColliders) {
      say("terrain: %s, %s", terrain.name.c_str(), name_of(collider));
      const Rest rest = run(terrain, collider, options);
      rows.push_back({{"hills", terrain.name},
                      {"collider", name_of(collider)},
                      {"mean mm/s", 1000 * rest.mean_speed},
                      {"fastest mm/s", 1000 * rest.fastest},
                      {"contacts a stone", rest.contacts},
                      {"lost", rest.lost}});
      if (collider != Collider::kExt) continue;
      if (terrain.far == 0) about_origin = rest;
      is_held = is_held && rest.lost == 0;
      is_same = is_same && rest.contacts <= 1.25 * about_origin.contacts;
    }
  report.table("terrain: how still they lie", rows);
  report.target("no stone goes through the ground", is_held);
  report.target("the place of hills in their mesh adds no more than a quarter to the contacts",
                is_same);
}

}  // namespace ode_ext::stability
