// SPDX-License-Identifier: BSD-3-Clause
// Stacks of cubes: mesh cubes should stand wherever ODE's boxes do.
#include <algorithm>
#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "bench/stability/bench.h"
#include "bench/stability/stack.h"
#include "bench/stability/trials.h"

namespace ode_ext::stability {
namespace {

constexpr double kOffset = 0.1;                          // sides
constexpr double kYaw = 15 * std::numbers::pi / 180;     // [rad]
constexpr double kPlateSize = 3, kPlateThickness = 0.5;  // [m]
constexpr int kPlateCells = 16;                          // quads along its side

enum class Ground { kPlate, kPlane };

struct Setting {
  bool aligned;
  Ground ground;
  double hz;
};

// Stacks of the same kind that differ by chance alone.
struct Group {
  std::string name;
  int height;  // 0: not a tower
  std::vector<std::vector<TestPose>> starts;
};

// Of a group, with one of the colliders.
struct Outcome {
  int stand = 0;
  double drift = 0;       // [m], of those that stand
  double fell_first = 0;  // [s], of those that fell
};

std::vector<Group> make_groups(const Setting& setting, const TrialOptions& options) {
  Random random(options.seed);
  std::vector<Group> groups;
  const int draws = setting.aligned || options.quick ? 1 : 3;
  for (int height = 1; height <= 10; ++height) {
    if (options.quick && height != 1 && height != 3 && height != 5) continue;
    Group group{std::to_string(height), height, {}};
    for (int i = 0; i < draws; ++i) {
      group.starts.push_back(setting.aligned ? tower(height, 0, 0, random)
                                             : tower(height, kOffset, kYaw, random));
    }
    groups.push_back(std::move(group));
  }
  if (setting.aligned) groups.push_back({"pyramid 5-4-3-2-1", 0, {pyramid(5)}});
  return groups;
}

std::vector<Outcome> run(const std::vector<Group>& groups, const Setting& setting,
                         Collider collider, const TrialOptions& options) {
  const Shape cube = box_shape({kSide, kSide, kSide});
  const Shape plate = box_shape({kPlateSize, kPlateSize, kPlateThickness}, kPlateCells);
  Bench bench({.collider = collider,
               .hz = setting.hz,
               .max_contacts = options.max_contacts,
               .seed = options.seed});
  std::vector<Stack> stacks;
  std::vector<std::vector<dBodyID>> bodies;
  for (const Group& group : groups) {
    for (const std::vector<TestPose>& start : group.starts) {
      const std::size_t cell = stacks.size();
      // Cells lie apart so that the broad phase has nothing to do between them.
      const Point middle{1.5 * kPlateSize * static_cast<double>(cell), 0, 0};
      if (setting.ground == Ground::kPlate) {
        bench.add_fixed(plate, {.position = middle + Point{0, 0, -kPlateThickness / 2}}, cell);
      }
      std::vector<TestPose> poses = start;
      for (TestPose& pose : poses) pose.position = pose.position + middle;
      stacks.emplace_back(poses);
      bodies.emplace_back();
      for (const TestPose& pose : poses) bodies.back().push_back(bench.add_body(cube, pose, cell));
    }
  }
  if (setting.ground == Ground::kPlane) bench.add_plane();

  const double seconds = options.quick ? 5 : 20;
  std::size_t standing = stacks.size();
  while (bench.time() < seconds && standing > 0) {
    bench.step();
    for (std::size_t cell = 0; cell < stacks.size(); ++cell) {
      if (!stacks[cell].stands()) continue;
      std::vector<Point> now;
      for (const dBodyID body : bodies[cell]) now.push_back(position(body));
      stacks[cell].look(now, bench.time());
      if (stacks[cell].stands()) continue;
      bench.retire(cell);
      --standing;
    }
  }

  std::vector<Outcome> outcomes;
  std::size_t cell = 0;
  for (const Group& group : groups) {
    Outcome outcome;
    outcome.fell_first = seconds;
    for (std::size_t i = 0; i < group.starts.size(); ++i, ++cell) {
      const Stack& stack = stacks[cell];
      if (stack.stands()) {
        ++outcome.stand;
        outcome.drift = std::max(outcome.drift, stack.drift());
      } else {
        outcome.fell_first = std::min(outcome.fell_first, stack.fell_at());
      }
    }
    outcomes.push_back(outcome);
  }
  return outcomes;
}

bool all_stand(const Group& group, const Outcome& outcome) {
  return outcome.stand == static_cast<int>(group.starts.size());
}

// Up to which height all towers stand.
int height_reached(const std::vector<Group>& groups, const std::vector<Outcome>& outcomes) {
  int reached = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (groups[i].height == 0) continue;
    if (!all_stand(groups[i], outcomes[i])) break;
    reached = groups[i].height;
  }
  return reached;
}

// How high the yardstick has to stand, and up to where meshes are held against it. Beyond that it
// is chance which of the boxes' towers stand.
int expected_height(const Setting& setting, const TrialOptions& options) {
  if (setting.hz > 100) return options.quick ? 5 : 10;
  return setting.aligned ? 5 : 3;
}

std::string name_of(const Setting& setting) {
  return std::string(setting.aligned ? "aligned" : "offset and turned") + ", on a " +
         (setting.ground == Ground::kPlate ? "plate" : "dPlane") + ", " +
         std::to_string(static_cast<int>(setting.hz)) + " Hz";
}

void run_setting(const Setting& setting, const TrialOptions& options, Report& report,
                 std::vector<Row>& summary) {
  const std::vector<Group> groups = make_groups(setting, options);
  std::array<std::vector<Outcome>, 3> outcomes;
  Row heights{{"towers", name_of(setting)}};
  for (std::size_t c = 0; c < outcomes.size(); ++c) {
    say("towers: %s, %s", name_of(setting).c_str(), name_of(kColliders[c]));
    outcomes[c] = run(groups, setting, kColliders[c], options);
    heights[name_of(kColliders[c])] = height_reached(groups, outcomes[c]);
  }
  summary.push_back(heights);

  const int expected = expected_height(setting, options);
  std::vector<Row> rows;
  int boxes_stand = 0, meshes_stand_too = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto count = std::to_string(groups[g].starts.size());
    Row row{{"height", groups[g].name}};
    for (std::size_t c = 0; c < outcomes.size(); ++c) {
      const Outcome& outcome = outcomes[c][g];
      const std::string name = name_of(kColliders[c]);
      const bool fell = !all_stand(groups[g], outcome);
      row[name] = std::to_string(outcome.stand) + " of " + count;
      row[name + " mm"] = outcome.stand > 0 ? Row(1000 * outcome.drift) : Row("-");
      row[name + " s"] = fell ? Row(outcome.fell_first) : Row("-");
    }
    rows.push_back(row);
    if (groups[g].height <= expected && all_stand(groups[g], outcomes[2][g])) {
      ++boxes_stand;
      meshes_stand_too += all_stand(groups[g], outcomes[0][g]);
    }
  }
  report.table("towers: " + name_of(setting) +
                   "; how many stand, how far [mm] those drifted "
                   "sideways, when [s] the first fell",
               rows);
  // Without a yardstick that stands there would be nothing to miss.
  report.target("the boxes stand at least " + std::to_string(expected) + " high",
                height_reached(groups, outcomes[2]) >= expected);
  report.target("mesh cubes stand wherever boxes do: " + std::to_string(meshes_stand_too) + " of " +
                    std::to_string(boxes_stand) + " kinds",
                meshes_stand_too == boxes_stand);
}

}  // namespace

void run_towers(const TrialOptions& options, Report& report) {
  report.note(
      "towers: cubes of 0.2 m for 20 s (5 s with --quick), mu 0.8. A stack has fallen once its top "
      "is\nlower by 0.02 m or a cube moved sideways by 0.05 m.");
  std::vector<Row> summary;
  for (const double hz : {240.0, 60.0}) {
    for (const Ground ground : {Ground::kPlate, Ground::kPlane}) {
      for (const bool aligned : {true, false}) {
        run_setting({aligned, ground, hz}, options, report, summary);
      }
    }
  }
  report.table("towers: height up to which all stand", summary);
}

}  // namespace ode_ext::stability
