// SPDX-License-Identifier: BSD-3-Clause
// What is said and kept at the end of a run.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <ostream>
#include <vector>

#include "paper/agreement.h"
#include "paper/options.h"
#include "paper/totals.h"

namespace paper {

struct Result {  // of a configuration
  Configuration configuration;
  std::uint64_t running_hash;
  Totals totals;
};

nlohmann::ordered_json summarize(const Options& options, const Agreement& agreement,
                                 const std::vector<Result>& results);
void print_summary(std::ostream& out, const nlohmann::ordered_json& summary);

}  // namespace paper
