// SPDX-License-Identifier: BSD-3-Clause
// Square rods that lie across each other edge on edge. No vertex is near. The truth is the overlap,
// along the axis that both edges are square to.
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "bench/accuracy/failures.h"
#include "bench/accuracy/known_pair.h"
#include "bench/accuracy/measures.h"
#include "bench/accuracy/trial.h"

namespace ode_ext::accuracy {
namespace {

constexpr double kWidth = 0.1, kLength = 1;  // [m]
constexpr double kDegree = std::numbers::pi / 180;

KnownPair make_crossing(const Body& rod, test::Random& random, test::OdeWorld& world,
                        bool lower_first) {
  const double angle = random.uniform(20, 90) * kDegree;
  const double overlap = random.uniform(0.005, 0.05) * kWidth;
  const double along_lower = random.uniform(-0.3, 0.3) * kLength;
  const double along_upper = random.uniform(-0.3, 0.3) * kLength;
  const test::TestPose on_edge = test::turned({1, 0, 0}, 45 * kDegree);
  test::TestPose upper = test::composed(test::turned({0, 0, 1}, angle), on_edge);
  upper.position = {along_lower + along_upper * std::cos(angle), along_upper * std::sin(angle),
                    std::sqrt(2.0) * kWidth - overlap};
  const test::TestPose frame = random.pose(1);  // all of it anywhere, turned in any way
  const test::TestPose pa = test::composed(frame, upper), pb = test::composed(frame, on_edge);
  const test::WayOut truth{overlap, test::rotate(frame, {0, 0, 1})};
  if (!is_shortest(truth, rod, pa, rod, pb)) throw std::logic_error("rods: a false truth");
  return make_known_pair(world, rod, pa, rod, pb, truth, lower_first);
}

}  // namespace

Measure prepare_rods(const Options& options, test::OdeWorld& world) {
  test::Random random(options.seed);
  const Body rod(world, test::make_rod(kLength, kWidth));
  std::vector<KnownPair> pairs;
  for (int i = 0; i < options.count_or(1000); ++i)
    pairs.push_back(make_crossing(rod, random, world, i % 2 == 1));
  return [pairs](Contestant& contestant) {
    const auto answers = contestant.collide(geoms_of(pairs));
    Share none, askew, wrong_depth;
    std::vector<double> angles, depths;
    Failures failures;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      none.count(answers[i].empty());
      for (const dContactGeom& c : answers[i]) {
        angles.push_back(degrees_between(test::normal(c), pairs[i].direction));
        askew.count(exceeds(angles.back(), kWrongAngle));
      }
      const dContactGeom* deepest = deepest_of(answers[i]);
      if (deepest != nullptr) {
        depths.push_back(100 * std::fabs(deepest->depth / pairs[i].depth - 1));
        wrong_depth.count(exceeds(depths.back(), 10));
      }
      if (deepest == nullptr || exceeds(depths.back(), 10) ||
          is_askew(*deepest, pairs[i].direction))
        failures.add(describe(deepest, pairs[i].direction, pairs[i].depth), pairs[i].geoms);
    }
    const double contacts = static_cast<double>(askew.all) / static_cast<double>(pairs.size());
    return Outcome{{{"pairs without a contact [%]", none.percent(), at_most(0)},
                    {"normals more than 5 degrees off [%]", askew.percent(), at_most(0)},
                    {"normals off at worst [degrees]", worst(angles)},
                    {"deepest more than 10 % off [%]", wrong_depth.percent(), at_most(0)},
                    {"deepest off at worst [%]", worst(depths)},
                    {"contacts per pair", contacts}},
                   {{"failures", failures.json()}}};
  };
}

}  // namespace ode_ext::accuracy
