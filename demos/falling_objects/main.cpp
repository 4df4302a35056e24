// SPDX-License-Identifier: BSD-3-Clause
// Meshes fall into a bowl: the two scenes of GRAPP section 6, and any other meshes. Try
// --help.
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
  if (parsed.options.wants_window(falling_objects::can_show_window())) {
    return falling_objects::run_window(parsed.options, &falling_objects::show_window);
  }
  return falling_objects::run(parsed.options, &falling_objects::make_film);
}
