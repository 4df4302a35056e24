// SPDX-License-Identifier: BSD-3-Clause
// The command line.
#pragma once

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "paper/configuration.h"
#include "simulation/simulation_settings.h"

namespace paper {

struct Options {
  std::string scene = "rigid";
  falling_objects::SimulationSettings simulation;
  int steps = 600;
  int every = 20;  // steps from one measurement of what is slow to the next
  std::string out;
  std::vector<Configuration> configurations;
  Configuration driver;  // one of `configurations`
  std::string command;   // as typed, for the record
  bool quiet = false;
  bool list = false;
};

struct ParsedOptions {
  Options options;
  std::optional<int> exit_code;  // set: help was asked for, or the command line is wrong
};

ParsedOptions parse_options(int argc, const char* const* argv, std::ostream& out,
                            std::ostream& err);

}  // namespace paper
