// SPDX-License-Identifier: BSD-3-Clause
// A way to run the library, by name: full or iterative, then what differs from the default.
#pragma once

#include <ode_ext/ode_ext.h>

#include <string>
#include <string_view>
#include <vector>

namespace paper {

// GRAPP section 5.4: a variability of 2 %.
inline constexpr const char* kPapersConfidence = "1.02";

enum class Rays { kFull, kIterative };

// The words of a name after the first, in the order in which they are written.
enum Word : unsigned {
  kChecked = 1 << 0,     // rays=iterative, else rays=iterative-paper
  kBasic = 1 << 1,       // deformable_target=basic
  kMonolithic = 1 << 2,  // organization=monolithic
  kExact = 1 << 3,       // workload=exact
  kPlain = 1 << 4,       // prediction=plain: Eq. 2
  kIgnore = 1 << 5,      // misprediction=ignore, with the paper's confidence
  kCount = 1 << 6,       // count_work=on
  kEdges = 1 << 7,       // edges=on; with full rays the library as it is by default
};

struct Configuration {
  Rays rays = Rays::kFull;
  unsigned words = 0;

  bool operator==(const Configuration&) const = default;
  bool has(Word word) const { return (words & word) != 0; }
  Configuration without(Word word) const { return {rays, words & ~unsigned{word}}; }
  // Gives the same bytes as every other one of which this is true that has edges too, or neither.
  bool is_lossless() const { return !follows_papers_rule() && !has(kIgnore); }
  // No temporal data, no ray; what the walk finds is believed. It depends on the steps before.
  bool follows_papers_rule() const { return rays == Rays::kIterative && !has(kChecked); }
  // So slow that it takes part in some steps only.
  bool is_sampled() const { return has(kCount) || has(kBasic); }
  std::string name() const;
  std::string config() const;  // of dBatchColliderParams
};

// Throws std::invalid_argument, a sentence that lists the words.
Configuration parse_configuration(std::string_view name);

// What the figures and tables need.
std::vector<Configuration> default_configurations(std::string_view scene);

}  // namespace paper
