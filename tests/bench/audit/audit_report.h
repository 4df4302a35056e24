// SPDX-License-Identifier: BSD-3-Clause
// The table of missed_pairs.
#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "bench/audit/kind_pair.h"

namespace ode_ext::audit {

// Prints the rows as they come, the first wrong answers, and at the end the totals.
class Report {
 public:
  Report();

  void add(const std::string& a, const std::string& b, const std::array<Tally, 3>& by_approach);
  void add_scene(const Tally& tally);
  // `seed` is that of the program. Only the first ten are told.
  void miss(const std::string& a, const std::string& b, std::uint64_t seed, const Miss& miss);
  void finish() const;

  const Tally& total() const { return total_; }
  nlohmann::json json(std::uint64_t seed) const;

 private:
  struct Row {
    std::string a, b;
    Tally tally;
  };
  void add_row(const std::string& a, const std::string& b, const Tally& tally);

  std::vector<Row> rows_;
  std::array<Tally, 3> by_approach_;
  Tally total_;
  std::vector<std::string> misses_;
};

}  // namespace ode_ext::audit
