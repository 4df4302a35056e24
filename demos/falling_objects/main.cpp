// SPDX-License-Identifier: BSD-3-Clause
// Runs a scene, in a window, in a film or unseen: the two of GRAPP section 6, others in
// demos/scenes, and files and meshes of the user's own. Try --help.
#include <cstdlib>
#include <iostream>

#include "falling_objects/options.h"
#include "falling_objects/run.h"
#include "falling_objects/show.h"

int main(int argc, char** argv) {
  // PoCL's workers are not bound to cores by default, and on small virtual machines they can end up
  // sharing one. Read when OpenCL starts, hence first; a value of the user's own is kept.
  setenv("POCL_AFFINITY", "1", 0);
  const auto parsed = falling_objects::parse_options(argc, argv, std::cout, std::cerr);
  if (parsed.exit_code) return *parsed.exit_code;
  const auto& options = parsed.options;
  if (options.pictures.window ||
      (options.may_have_window() && falling_objects::can_show_window())) {
    return falling_objects::run_window(options, &falling_objects::show_window);
  }
  return falling_objects::run(options, &falling_objects::make_film);
}
