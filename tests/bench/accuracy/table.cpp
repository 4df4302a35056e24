// SPDX-License-Identifier: BSD-3-Clause
// How far off the deepest contact is, for every ordered pair of some convex shapes: 1 % and 10 % of
// the smaller size into each other, and for balls against what the formula says.
#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/accuracy/failures.h"
#include "bench/accuracy/measures.h"
#include "bench/accuracy/pressed_pair.h"
#include "bench/accuracy/trial.h"
#include "support/convex_makers.h"

namespace ode_ext::accuracy {
namespace {

using test::operator+;
using test::operator*;

constexpr double kShares[] = {0.01, 0.1};

struct Cell {
  std::string name;
  double share;
  std::vector<KnownPair> pairs;
};

// What a cell, or all of them together, is off by.
class Errors {
 public:
  Share none;
  std::vector<double> depths, angles, counts;  // [%], [degrees], contacts per pair
  double too_deep = 0;                         // [%] the worst
  nlohmann::json worst_pair;                   // by depth

  void add(const KnownPair& pair, const test::Contacts& contacts) {
    none.count(contacts.empty());
    counts.push_back(static_cast<double>(contacts.size()));
    const dContactGeom* deepest = deepest_of(contacts);
    const double off = deepest == nullptr ? -100 : 100 * (deepest->depth / pair.depth - 1);
    if (worst_pair.empty() || exceeds(std::fabs(off), worst_)) {
      worst_ = std::fabs(off);
      worst_pair = poses_of(pair.geoms);
      worst_pair["what"] = describe(deepest, pair.direction, pair.depth);
    }
    if (deepest == nullptr) return;
    depths.push_back(std::fabs(off));
    too_deep = std::max(too_deep, off);
    angles.push_back(degrees_between(test::normal(*deepest), pair.direction));
  }

 private:
  double worst_ = 0;
};

struct Shape {
  const char* name;
  Body body;
};

std::vector<Shape> make_shapes(test::Random& random, test::OdeWorld& world) {
  return {{"cube", {world, test::make_cube(1)}},
          {"sphere", {world, test::make_icosphere(0.5, 2)}},
          {"cylinder", {world, test::make_cylinder(0.4, 1, 16)}},
          {"cone", {world, test::make_cone(0.5, 1, 16)}},
          {"hull", {world, test::make_random_hull(random, 20, 0.5)}}};
}

std::string pair_name(const char* a, const char* b) { return std::string(a) + " on " + b; }

Cell press_cell(const Shape& a, const Shape& b, double share, int count, test::Random& random,
                Share& libccd_differing, test::OdeWorld& world) {
  Cell cell{pair_name(a.name, b.name), share, {}};
  for (int i = 0; i < count; ++i) {
    const PressedPair p = press_together(a.body, b.body, share, random);
    libccd_differing.count(libccd_differs(a.body, b.body, p));
    cell.pairs.push_back(make_known_pair(world, a.body, p.pa, b.body, p.pb, p.out, false));
  }
  return cell;
}

// Balls of 20,480 triangles, whose facets are at most 0.03 % of the radius below the sphere.
constexpr double kRadius = 0.5;

Cell ball_on_cube(const Body& ball, const Body& cube, double share, int count, test::Random& random,
                  test::OdeWorld& world) {
  Cell cell{"sphere on cube's face, by formula", share, {}};
  for (int i = 0; i < count; ++i) {
    const double depth = share * 2 * kRadius;
    const test::TestPose frame = random.pose(1);
    test::TestPose above = random.pose(0);
    // Away from the rim: the ball is at most 0.3 wide where it enters.
    above.position = {random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15),
                      0.5 + kRadius - depth};
    cell.pairs.push_back(make_known_pair(world, ball, test::composed(frame, above), cube, frame,
                                         {depth, test::rotate(frame, {0, 0, 1})}, i % 2 == 1));
  }
  return cell;
}

Cell ball_on_ball(const Body& ball, double share, int count, test::Random& random,
                  test::OdeWorld& world) {
  Cell cell{"sphere on sphere, by formula", share, {}};
  for (int i = 0; i < count; ++i) {
    const double depth = share * 2 * kRadius;
    const test::Point direction = random.direction();
    const test::TestPose pb = random.pose(1);
    test::TestPose pa = random.pose(0);
    pa.position = pb.position + (2 * kRadius - depth) * direction;
    cell.pairs.push_back(make_known_pair(world, ball, pa, ball, pb, {depth, direction}, false));
  }
  return cell;
}

struct Table {
  std::vector<Cell> cells;
  Share libccd_differing;
};

std::shared_ptr<const Table> make_table(const Options& options, test::OdeWorld& world) {
  test::Random random(options.seed);
  const int count = options.count_or(200);
  const std::vector<Shape> shapes = make_shapes(random, world);
  const Body cube(world, test::make_cube(1)), ball(world, test::make_icosphere(kRadius, 5));
  const auto table = std::make_shared<Table>();
  for (const double share : kShares) {
    for (const Shape& a : shapes) {
      for (const Shape& b : shapes) {
        table->cells.push_back(
            press_cell(a, b, share, count, random, table->libccd_differing, world));
      }
    }
    table->cells.push_back(ball_on_cube(ball, cube, share, count, random, world));
    table->cells.push_back(ball_on_ball(ball, share, count, random, world));
  }
  return table;
}

nlohmann::json row_of(const Cell& cell, const Errors& errors) {
  return {{"pair", cell.name},
          {"share", cell.share},
          {"pairs", cell.pairs.size()},
          {"none", errors.none.percent()},
          {"depth_99", percentile(errors.depths, 99)},
          {"depth_worst", worst(errors.depths)},
          {"angle_99", percentile(errors.angles, 99)},
          {"angle_worst", worst(errors.angles)},
          {"contacts", mean(errors.counts)},
          {"worst_pair", errors.worst_pair}};
}

void add_figures(double share, const Errors& errors, std::vector<Figure>& figures) {
  const std::string start = std::to_string(static_cast<int>(100 * share + 0.5)) + " % deep: ";
  figures.push_back({start + "pairs without a contact [%]", errors.none.percent()});
  figures.push_back({start + "depth off, 99th percentile [%]", percentile(errors.depths, 99)});
  figures.push_back({start + "depth off, worst [%]", worst(errors.depths)});
  figures.push_back({start + "depth too deep, worst [%]", errors.too_deep});
  figures.push_back(
      {start + "angle off, 99th percentile [degrees]", percentile(errors.angles, 99)});
  figures.push_back({start + "angle off, worst [degrees]", worst(errors.angles)});
  figures.push_back({start + "contacts per pair", mean(errors.counts)});
}

}  // namespace

Measure prepare_table(const Options& options, test::OdeWorld& world) {
  return [table = make_table(options, world)](Contestant& contestant) {
    Outcome outcome{{}, nlohmann::json::array()};
    for (const double share : kShares) {
      Errors together;
      for (const Cell& cell : table->cells) {
        if (cell.share != share) continue;
        const auto answers = contestant.collide(geoms_of(cell.pairs));
        Errors errors;
        for (std::size_t i = 0; i < cell.pairs.size(); ++i) {
          errors.add(cell.pairs[i], answers[i]);
          together.add(cell.pairs[i], answers[i]);
        }
        outcome.details.push_back(row_of(cell, errors));
      }
      add_figures(share, together, outcome.figures);
    }
    outcome.figures.push_back(
        {"(libccd differs from the truth [%])", table->libccd_differing.percent()});
    return outcome;
  };
}

}  // namespace ode_ext::accuracy
