// SPDX-License-Identifier: BSD-3-Clause
// A plate 5 mm thick, pressed 10 mm into the rim of a block: rays straight through the plate leave
// it before they are out of the block. Two ways, and what is true of each:
//
// laid in   The plate is level and its lower large face is 10 mm below the block's top, so all of
//           its thickness is under the top. Its inner end reaches 30 to 80 mm across the rim, the
//           rest sticks out. Truth: straight up (along the normal of the top), by 10 mm.
// edge on   The plate is level, and its end is pressed 10 mm into the upright side of the block,
//           20 mm or more below the top and above the bottom. Truth: along the normal of the side,
//           by 10 mm, that being how deep the foremost corner is.
//
// In both it is anywhere along the rim and turned about the vertical by up to 20 degrees. What the
// least separation really is, is asked of all separating axes; where it is another (edge on, over
// an end of the rim, where the end of the plate is the shorter way) the place is drawn again.
#include <cmath>
#include <numbers>

#include "bench/accuracy/failures.h"
#include "bench/accuracy/known_pair.h"
#include "bench/accuracy/measures.h"
#include "bench/accuracy/trial.h"

namespace ode_ext::accuracy {
namespace {

// [m]
constexpr double kBlock = 0.2;  // the block's side
constexpr double kThickness = 0.005, kPlateLength = 0.3, kPlateWidth = 0.15;
constexpr double kPressed = 0.01;
constexpr double kSteepest = 20 * std::numbers::pi / 180;  // [rad]

struct Bodies {
  Bodies(test::OdeWorld& world, int cells)
      : block(world, test::make_cube(kBlock, cells)),
        plate(world, test::make_box({kPlateLength, kPlateWidth, kThickness}, 2 * cells, cells)) {}
  Body block, plate;
};

// The plate's inner end is towards -x; the least of its corners gets the given x.
test::TestPose placed(double innermost, double y, double z, double yaw) {
  const double half = std::cos(yaw) * kPlateLength / 2 + std::fabs(std::sin(yaw)) * kPlateWidth / 2;
  return test::turned({0, 0, 1}, yaw, {innermost + half, y, z});
}

struct Laid {
  test::TestPose pose;
  test::Point out;
};

Laid laid_in(test::Random& random) {
  const double reach = random.uniform(0.03, 0.08);
  const double y = random.uniform(-kBlock / 2, kBlock / 2);
  const double yaw = random.uniform(-kSteepest, kSteepest);
  return {placed(kBlock / 2 - reach, y, kBlock / 2 - kPressed + kThickness / 2, yaw), {0, 0, 1}};
}

Laid edge_on(test::Random& random) {
  const double highest = kBlock / 2 - 0.02 - kThickness / 2;
  const double y = random.uniform(-kBlock / 2, kBlock / 2), z = random.uniform(-highest, highest);
  const double yaw = random.uniform(-kSteepest, kSteepest);
  return {placed(kBlock / 2 - kPressed, y, z, yaw), {1, 0, 0}};
}

std::vector<KnownPair> press(const Options& options, Laid (*lay)(test::Random&),
                             test::OdeWorld& world) {
  test::Random random(options.seed);
  const Bodies kinds[] = {{world, 1}, {world, 5}};  // few triangles and many
  std::vector<KnownPair> pairs;
  while (pairs.size() < static_cast<std::size_t>(options.count_or(1000))) {
    const Bodies& bodies = kinds[random.below(2)];
    const Laid laid = lay(random);
    const test::TestPose frame = random.pose(1);
    const test::TestPose pa = test::composed(frame, laid.pose);
    const test::WayOut truth{kPressed, test::rotate(frame, laid.out)};
    if (!is_shortest(truth, bodies.plate, pa, bodies.block, frame)) continue;
    pairs.push_back(make_known_pair(world, bodies.plate, pa, bodies.block, frame, truth,
                                    pairs.size() % 2 == 1));
  }
  return pairs;
}

void measure(const char* name, const std::vector<KnownPair>& pairs, Contestant& contestant,
             std::vector<Figure>& figures, Failures& failures) {
  const auto answers = contestant.collide(geoms_of(pairs));
  Share none, askew, wrong_depth;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const dContactGeom* deepest = deepest_of(answers[i]);
    none.count(deepest == nullptr);
    if (deepest == nullptr || is_askew(*deepest, pairs[i].direction)) {
      failures.add(std::string(name) + ": " + describe(deepest, pairs[i].direction, pairs[i].depth),
                   pairs[i].geoms);
    }
    if (deepest == nullptr) continue;
    askew.count(is_askew(*deepest, pairs[i].direction));
    wrong_depth.count(exceeds(std::fabs(deepest->depth / pairs[i].depth - 1), 0.1));
  }
  const std::string start = std::string(name) + ": ";
  figures.push_back({start + "pairs without a contact [%]", none.percent(), at_most(0)});
  figures.push_back({start + "deepest more than 5 degrees off [%]", askew.percent(), at_most(0)});
  figures.push_back({start + "deepest more than 10 % off [%]", wrong_depth.percent()});
}

}  // namespace

Measure prepare_plate(const Options& options, test::OdeWorld& world) {
  return [in = press(options, laid_in, world),
          on = press(options, edge_on, world)](Contestant& contestant) {
    Outcome outcome;
    Failures failures;
    measure("laid in", in, contestant, outcome.figures, failures);
    measure("edge on", on, contestant, outcome.figures, failures);
    outcome.details = {{"failures", failures.json()}};
    return outcome;
  };
}

}  // namespace ode_ext::accuracy
