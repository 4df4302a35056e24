// SPDX-License-Identifier: BSD-3-Clause
// A trial: scenes with a known truth, and figures of how far a collider is from it.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/accuracy/contestant.h"

namespace ode_ext::accuracy {

struct Options {
  std::uint64_t seed = 1;
  int count = 0;  // of scenes; 0: the trial's own
  int count_or(int usual) const { return count > 0 ? count : usual; }
};

struct Target {
  enum class Side { kAtMost, kAtLeast } side;
  double bound;
  bool met_by(double value) const {
    return side == Side::kAtMost ? value <= bound : value >= bound;
  }
};
inline Target at_most(double bound) { return {Target::Side::kAtMost, bound}; }
inline Target at_least(double bound) { return {Target::Side::kAtLeast, bound}; }

struct Figure {
  std::string name;  // a unit in brackets, where there is one
  double value = 0;
  std::optional<Target> target = {};
};

struct Outcome {
  std::vector<Figure> figures;  // the same in the same order for every contestant
  nlohmann::json details = {};  // what the figures do not say: cells of a table, cases that failed
};

// The scenes are made once, so that both contestants get the same.
using Measure = std::function<Outcome(Contestant&)>;

struct Trial {
  const char* name;
  const char* sentence;
  Measure (*prepare)(const Options& options, test::OdeWorld& world);  // lives as long as the world
};

Measure prepare_cubes(const Options& options, test::OdeWorld& world);
Measure prepare_rods(const Options& options, test::OdeWorld& world);
Measure prepare_plate(const Options& options, test::OdeWorld& world);
Measure prepare_separation(const Options& options, test::OdeWorld& world);
Measure prepare_table(const Options& options, test::OdeWorld& world);
Measure prepare_inverted(const Options& options, test::OdeWorld& world);
Measure prepare_composite(const Options& options, test::OdeWorld& world);
Measure prepare_coincident(const Options& options, test::OdeWorld& world);

std::span<const Trial> all_trials();

}  // namespace ode_ext::accuracy
