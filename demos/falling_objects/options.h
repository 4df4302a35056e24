// SPDX-License-Identifier: BSD-3-Clause
// The command line.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "falling_objects/picture_options.h"
#include "scene_file/scene_description.h"
#include "simulation/exit_code.h"
#include "simulation/simulation_settings.h"

namespace falling_objects {

struct Options : SimulationSettings {
  std::string scene = "rigid";
  SceneDescription description;     // what the file of that name says, with the options applied
  int steps = 600;                  // GRAPP section 6: 10 s at 60 Hz
  std::vector<std::string> meshes;  // files, or NAME=FILE; none: those of the scene

  std::string csv;
  bool check = false;
  bool check_rest = false;
  bool quiet = false;
  std::string snapshot;
  PictureOptions pictures;
  std::string record;

  // What a run in a window does not do.
  bool wants_more_than_a_window() const {
    return check || check_rest || compare || !csv.empty() || !snapshot.empty() || !record.empty() ||
           pictures.has_film();
  }
  bool may_have_window() const {
    return !pictures.no_window && !quiet && !wants_more_than_a_window();
  }
  // The last 0.5 s, over which speeds are judged.
  std::size_t rest_steps() const {
    return static_cast<std::size_t>(std::max(1L, std::lround(0.5 * hz)));
  }
};

struct ParsedOptions {
  Options options;
  std::optional<int> exit_code;  // set: help was asked for, or the command line is wrong
};

ParsedOptions parse_options(int argc, const char* const* argv, std::ostream& out,
                            std::ostream& err);

}  // namespace falling_objects
