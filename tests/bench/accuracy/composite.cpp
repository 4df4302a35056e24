// SPDX-License-Identifier: BSD-3-Clause
// Meshes of which several parts touch at once, each with a truth of its own: how deep it is, and
// which way it leaves.
//
// plates   Two plates of one mesh, in the middle of opposite rims of a block.
// inside   One part wholly inside a block, near its top, the other in its top.
// rack     49 feet of different lengths in one face: more than there may be contacts.
// comb     Eight teeth in one face, tilted by up to a degree.
// h        An H of bars in a frame, all four ends in it: they leave inwards, two up and two down.
//
// All but the rack are made of few triangles and of many. A contact is of the part that is nearest
// to it, and of each part the deepest contact counts.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "bench/accuracy/failures.h"
#include "bench/accuracy/known_pair.h"
#include "bench/accuracy/measures.h"
#include "bench/accuracy/trial.h"

namespace ode_ext::accuracy {
namespace {

using test::Point;
using test::operator+;
using test::operator*;
using test::TestMesh;

// In the frame of the second mesh until the scene is placed.
struct Part {
  Point centre;
  Point direction;  // unit, into the first mesh
  double depth;     // [m]
};

struct Scene {
  test::GeomPair geoms;
  std::vector<Part> parts;
};

struct Drawn {
  TestMesh first, second;
  test::TestPose pose;  // of the first
  std::vector<Part> parts;
};

constexpr double kBlock = 0.2;  // [m] high, and wide enough
const Point kUp = {0, 0, 1}, kDown = {0, 0, -1};

TestMesh block() { return test::make_box({1, 1, kBlock}); }

TestMesh box_at(const Point& extents, const Point& centre, int cuts) {
  return test::moved(test::make_box(extents, cuts, cuts, cuts), centre);
}

Drawn draw_plates(test::Random& random, int cuts) {
  Drawn drawn{{}, block(), test::turned(kUp, random.uniform(-3, 3)), {}};
  drawn.pose.position = {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 0};
  for (const double sign : {1.0, -1.0}) {
    const double depth = random.uniform(0.005, 0.02);
    const double z = sign * (kBlock / 2 - depth + 0.1);
    drawn.first = test::merged(drawn.first, box_at({0.2, 0.005, 0.2}, {0, 0, z}, cuts));
    drawn.parts.push_back({{0, 0, sign * kBlock / 2}, {0, 0, sign}, depth});
  }
  return drawn;
}

Drawn draw_inside(test::Random& random, int cuts) {
  Drawn drawn{{}, block(), test::turned(kUp, random.uniform(-3, 3)), {}};
  const double sizes[] = {0.03, 0.05};
  const double depths[] = {random.uniform(0.035, 0.06), random.uniform(0.005, 0.02)};
  for (int i = 0; i < 2; ++i) {
    const Point centre = {i == 0 ? -0.1 : 0.1, 0, kBlock / 2 - depths[i] + sizes[i] / 2};
    drawn.first = test::merged(drawn.first, box_at({sizes[i], sizes[i], sizes[i]}, centre, cuts));
    drawn.parts.push_back({test::to_world(drawn.pose, centre), kUp, depths[i]});
  }
  return drawn;
}

Drawn draw_rack(test::Random& random, int) {
  Drawn drawn{{}, block(), {}, {}};
  for (int i = 0; i < 49; ++i) {
    const double depth = random.uniform(0.004, 0.012);
    const Point foot = {0.1 * (i % 7 - 3), 0.1 * (i / 7 - 3), kBlock / 2};
    drawn.first =
        test::merged(drawn.first, box_at({0.04, 0.04, 0.1}, foot + Point{0, 0, 0.05 - depth}, 1));
    drawn.parts.push_back({foot, kUp, depth});
  }
  return drawn;
}

Drawn draw_comb(test::Random& random, int cuts) {
  constexpr int kTeeth = 8;
  constexpr double kTooth = 0.04, kLength = (2 * kTeeth - 1) * kTooth;
  const double tilt = random.uniform(-1, 1) * std::numbers::pi / 180;
  const TestMesh comb = test::make_comb(kTeeth, kTooth, 0.1, 0.04);
  Drawn drawn{comb, test::make_box({1, 1, kBlock}, 4 * cuts, 4 * cuts, cuts), {}, {}};
  drawn.pose =
      test::composed(test::turned({0, 1, 0}, tilt), test::turned({1, 0, 0}, std::numbers::pi));
  double top = 0;  // of the teeth, before they are turned over
  for (std::size_t i = 0; i < comb.vertices.size() / 3; ++i) top = std::max(top, comb.vertex(i)[2]);
  drawn.pose.position[2] =
      kBlock / 2 + top - random.uniform(0.004, 0.01) - std::fabs(std::sin(tilt)) * kLength / 2;
  for (int i = 0; i < kTeeth; ++i) {
    const double x = 2 * i * kTooth - kLength / 2;
    double lowest = 1;
    for (const double corner : {x, x + kTooth})
      lowest = std::min(lowest, test::to_world(drawn.pose, {corner, 0, top})[2]);
    if (lowest < kBlock / 2)
      drawn.parts.push_back(
          {test::to_world(drawn.pose, {x + kTooth / 2, 0, top}), kUp, kBlock / 2 - lowest});
  }
  return drawn;
}

Drawn draw_h(test::Random& random, int cuts) {
  constexpr double kSide = 0.5, kBar = 0.08;  // of the frame, to the middle of its bars
  Drawn drawn;
  for (const double sign : {1.0, -1.0}) {
    const double reach = kSide + kBar;
    drawn.second =
        test::merged(drawn.second, box_at({reach, kBar, kBar}, {0, 0, sign * kSide / 2}, cuts));
    drawn.second = test::merged(drawn.second,
                                box_at({kBar, kBar, kSide - kBar}, {sign * kSide / 2, 0, 0}, cuts));
  }
  const double above = random.uniform(0.005, 0.02), below = random.uniform(0.005, 0.02);
  const double inner = (kSide - kBar) / 2;
  for (const double x : {-0.1, 0.1}) {
    drawn.first = test::merged(drawn.first, box_at({0.03, 0.03, 2 * inner + above + below},
                                                   {x, 0, (above - below) / 2}, cuts));
    drawn.parts.push_back({{x, 0, inner}, kDown, above});
    drawn.parts.push_back({{x, 0, -inner}, kUp, below});
  }
  drawn.first = test::merged(drawn.first, box_at({0.2, 0.02, 0.02}, {0, 0, 0}, cuts));
  return drawn;
}

std::vector<Scene> make_scenes(const Options& options, Drawn (*draw)(test::Random&, int),
                               test::OdeWorld& world) {
  test::Random random(options.seed);
  std::vector<Scene> scenes;
  for (int i = 0; i < options.count_or(100); ++i) {
    Drawn drawn = draw(random, i % 2 == 0 ? 1 : 6);
    const test::TestPose frame = random.pose(1);
    for (Part& part : drawn.parts) {
      part.centre = test::to_world(frame, part.centre);
      part.direction = test::rotate(frame, part.direction);
    }
    const dGeomID first = world.geom(world.mesh(drawn.first), test::composed(frame, drawn.pose));
    const dGeomID second = world.geom(world.mesh(drawn.second), frame);
    scenes.push_back({{first, second}, std::move(drawn.parts)});
    if (i % 4 < 2) continue;  // the other way about
    std::swap(scenes.back().geoms.first, scenes.back().geoms.second);
    for (Part& part : scenes.back().parts) part.direction = -1.0 * part.direction;
  }
  return scenes;
}

// Of each part the deepest contact; null: it has none.
std::vector<const dContactGeom*> deepest_of_parts(const Scene& scene,
                                                  const test::Contacts& contacts) {
  std::vector<const dContactGeom*> deepest(scene.parts.size());
  for (const dContactGeom& c : contacts) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < scene.parts.size(); ++i)
      if (test::distance(test::pos(c), scene.parts[i].centre) <
          test::distance(test::pos(c), scene.parts[nearest].centre))
        nearest = i;
    const dContactGeom*& of_part = deepest[nearest];
    if (of_part == nullptr || c.depth > of_part->depth) of_part = &c;
  }
  return deepest;
}

void measure(const char* name, const std::vector<Scene>& scenes, Contestant& contestant,
             std::vector<Figure>& figures, Failures& failures) {
  std::vector<test::GeomPair> geoms;
  for (const Scene& scene : scenes) geoms.push_back(scene.geoms);
  const auto answers = contestant.collide(geoms);
  Share none, askew, wrong;
  std::vector<double> depths;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto deepest = deepest_of_parts(scenes[i], answers[i]);
    for (std::size_t k = 0; k < deepest.size(); ++k) {
      const Part& part = scenes[i].parts[k];
      const bool has_room = answers[i].size() < contestant.limit();
      if (deepest[k] == nullptr && !has_room) continue;
      none.count(deepest[k] == nullptr);
      if (deepest[k] != nullptr) {
        askew.count(is_askew(*deepest[k], part.direction));
        depths.push_back(100 * std::fabs(deepest[k]->depth / part.depth - 1));
        wrong.count(exceeds(depths.back(), 5));
      }
      if (deepest[k] == nullptr || exceeds(depths.back(), 5) ||
          is_askew(*deepest[k], part.direction))
        failures.add(std::string(name) + ": " + describe(deepest[k], part.direction, part.depth),
                     scenes[i].geoms);
    }
  }
  const std::string start = std::string(name) + ": ";
  figures.push_back(
      {start + "parts without a contact, where there is room [%]", none.percent(), at_most(0)});
  figures.push_back({start + "more than 5 degrees off [%]", askew.percent(), at_most(0)});
  figures.push_back({start + "depth more than 5 % off [%]", wrong.percent(), at_most(0)});
  figures.push_back({start + "depth off at worst [%]", worst(depths)});
}

}  // namespace

Measure prepare_composite(const Options& options, test::OdeWorld& world) {
  const std::pair<const char*, Drawn (*)(test::Random&, int)> kinds[] = {{"plates", draw_plates},
                                                                         {"inside", draw_inside},
                                                                         {"rack", draw_rack},
                                                                         {"comb", draw_comb},
                                                                         {"h", draw_h}};
  std::vector<std::pair<const char*, std::vector<Scene>>> all;
  for (const auto& [name, draw] : kinds) all.emplace_back(name, make_scenes(options, draw, world));
  return [all](Contestant& contestant) {
    Outcome outcome;
    Failures failures;
    for (const auto& [name, scenes] : all)
      measure(name, scenes, contestant, outcome.figures, failures);
    outcome.details = {{"failures", failures.json()}};
    return outcome;
  };
}

}  // namespace ode_ext::accuracy
