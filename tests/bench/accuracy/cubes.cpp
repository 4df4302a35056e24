// SPDX-License-Identifier: BSD-3-Clause
// A cube on a cube, as in a stack that was not piled carefully. The truth is the overlap, upwards,
// and the upper cube is held up where it should be: at the corners of the area that both share.
#include <cmath>
#include <numbers>

#include "bench/accuracy/failures.h"
#include "bench/accuracy/known_pair.h"
#include "bench/accuracy/measures.h"
#include "bench/accuracy/polygon.h"
#include "bench/accuracy/trial.h"

namespace ode_ext::accuracy {
namespace {

constexpr double kSide = 1;                // [m]
constexpr double kOverlap = 0.01 * kSide;  // [m]
constexpr double kOffset = 0.9 * kSide;    // [m] the most, along x and y
constexpr double kNear = 0.02 * kSide;     // [m] a contact so close to a corner holds it up

struct Stack {
  KnownPair pair;
  Polygon shared;
};

std::vector<Stack> make_stacks(const Options& options, test::OdeWorld& world) {
  test::Random random(options.seed);
  const Body cube(world, test::make_cube(kSide));
  std::vector<Stack> stacks;
  while (stacks.size() < static_cast<std::size_t>(options.count_or(2000))) {
    const double x = random.uniform(-kOffset, kOffset), y = random.uniform(-kOffset, kOffset);
    const double yaw = random.uniform(0, 2 * std::numbers::pi);
    const Polygon lower = square(kSide, {0, 0}, 0), upper = square(kSide, {x, y}, yaw);
    // Where sliding off is nearly as short as upwards there is no one truth. Beyond twice the
    // overlap a contact that points sideways is wrong by its depth too.
    if (least_sideways(lower, upper) <= 2 * kOverlap) continue;
    const test::TestPose pose = test::turned({0, 0, 1}, yaw, {x, y, kSide - kOverlap});
    const KnownPair pair =
        make_known_pair(world, cube, pose, cube, {}, {kOverlap, {0, 0, 1}}, stacks.size() % 2 == 1);
    stacks.push_back({pair, intersection(lower, upper)});
  }
  return stacks;
}

bool is_held_up(const Point2& corner, const test::Contacts& contacts) {
  for (const dContactGeom& c : contacts) {
    if (std::hypot(c.pos[0] - corner.x(), c.pos[1] - corner.y()) < kNear) return true;
  }
  return false;
}

}  // namespace

Measure prepare_cubes(const Options& options, test::OdeWorld& world) {
  return [stacks = make_stacks(options, world)](Contestant& contestant) {
    std::vector<test::GeomPair> geoms;
    for (const Stack& stack : stacks) geoms.push_back(stack.pair.geoms);
    const auto answers = contestant.collide(geoms);
    Share too_deep, askew, none, held_up;
    Failures failures;
    for (std::size_t i = 0; i < stacks.size(); ++i) {
      const KnownPair& pair = stacks[i].pair;
      none.count(answers[i].empty());
      if (answers[i].empty()) failures.add("no contact", pair.geoms);
      for (const dContactGeom& c : answers[i]) {
        const bool is_too_deep = exceeds(c.depth, 2 * kOverlap);
        const bool askew_or_not = is_askew(c, pair.direction);
        too_deep.count(is_too_deep);
        askew.count(askew_or_not);
        if (is_too_deep || askew_or_not)
          failures.add(describe(&c, pair.direction, pair.depth), pair.geoms);
      }
      for (const Point2& corner : stacks[i].shared) held_up.count(is_held_up(corner, answers[i]));
    }
    const double contacts = static_cast<double>(askew.all) / static_cast<double>(stacks.size());
    return Outcome{{{"contacts deeper than twice the overlap [%]", too_deep.percent(), at_most(0)},
                    {"normals more than 5 degrees off [%]", askew.percent(), at_most(1)},
                    {"pairs without a contact [%]", none.percent(), at_most(0)},
                    {"corners held up [%]", held_up.percent()},
                    {"contacts per pair", contacts}},
                   {{"failures", failures.json()}}};
  };
}

}  // namespace ode_ext::accuracy
