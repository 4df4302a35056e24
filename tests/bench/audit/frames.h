// SPDX-License-Identifier: BSD-3-Clause
// Which frames of a falling pile a program looks at.
#pragma once

#include <CLI/CLI.hpp>

namespace ode_ext::audit {

struct Frames {
  int count = 20, first_step = 400, every = 10;

  bool has(int step) const { return step >= first_step && (step - first_step) % every == 0; }

  // `least`: 0 where there may be no pile at all.
  void add_options(CLI::App& app, int least) {
    app.add_option("--frames", count, least == 0 ? "Of the pile; 0: no pile" : "Of the pile")
        ->check(CLI::Range(least, 1000000))
        ->capture_default_str();
    app.add_option("--first-step", first_step, "The first frame")
        ->check(CLI::Range(0, 1000000))
        ->capture_default_str();
    app.add_option("--every", every, "Steps from one frame to the next")
        ->check(CLI::Range(1, 1000000))
        ->capture_default_str();
  }
};

}  // namespace ode_ext::audit
