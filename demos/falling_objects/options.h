// SPDX-License-Identifier: BSD-3-Clause
// The command line.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "falling_objects/picture_options.h"
#include "falling_objects/scene_description.h"

namespace falling_objects {

enum class Collider { kBatch, kOde };

enum ExitCode { kExitOk = 0, kExitCheckFailed = 1, kExitUsage = 2, kExitNoDevice = 3 };

struct Options {
  std::string scene = "rigid";
  SceneDescription description;  // what the file of that name says, with the options applied
  int objects = 1000;
  int sheets = 0;
  int steps = 600;  // GRAPP section 6: 10 s at 60 Hz
  double hz = 60;
  std::uint64_t seed = 1;
  std::vector<std::string> meshes;  // files, or NAME=FILE; none: those of the scene

  Collider collider = Collider::kBatch;  // the one whose contacts drive the simulation
  bool compare = false;
  int max_contacts = 16;
  std::string device;  // empty: the environment, else the library's choice
  std::string config;  // as dBatchColliderParams::config
  bool trust_meshes = false;

  std::string csv;
  bool check = false;
  bool check_rest = false;
  bool quiet = false;
  std::string snapshot;
  PictureOptions pictures;
  std::string record;

  // The run is to be looked at, not to be measured.
  bool wants_window(bool there_is_a_display) const {
    const bool measures =
        check || check_rest || compare || !csv.empty() || !snapshot.empty() || !record.empty();
    return pictures.window || (there_is_a_display && !pictures.no_window && !quiet && !measures &&
                               !pictures.has_film());
  }
  bool has_sheets() const { return sheets > 0; }
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
