// SPDX-License-Identifier: BSD-3-Clause
// Do the configurations that must give the same bytes do so? In every step each is compared with
// the one that differs from it in one word, or with the driver where that one does not take part.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "paper/configuration.h"

namespace paper {

struct Comparison {
  std::string claim;  // "pipelined == monolithic", ...
  std::size_t first, second;
  int steps = 0;
  int differing = 0;
  int first_difference = -1;
};

// All comparisons of one claim.
struct Verdict {
  std::string claim;
  int steps = 0;  // of all comparisons together
  int differing = 0;
  std::vector<Comparison> comparisons;
};

class Agreement {
 public:
  Agreement(const std::vector<Configuration>& configurations, std::size_t driver);

  // The hash of each configuration's contacts; none: it did not take part in the step.
  void after_step(int step, const std::vector<std::optional<std::uint64_t>>& hashes);

  std::vector<Verdict> verdicts() const;
  bool holds() const;

 private:
  std::vector<Comparison> comparisons_;
};

}  // namespace paper
