// SPDX-License-Identifier: BSD-3-Clause
// What a trial found, for people and for programs.
#pragma once

#include <cstdio>
#include <nlohmann/json.hpp>

#include "bench/accuracy/trial.h"

namespace ode_ext::accuracy {

struct Result {
  const Trial* trial;
  Outcome ode_ext, stock;
  int stock_given_up = 0;  // pairs on which stock ODE failed an assertion of its own
};

// Whether ode_ext meets every target.
bool meets_targets(const Result& result);

void print(const Result& result, std::FILE* out);

nlohmann::json json_of(const Result& result);

}  // namespace ode_ext::accuracy
