// SPDX-License-Identifier: BSD-3-Clause
// Measures what the figures and tables of GRAPP section 5 show. Try run --help.
#include <cstdlib>
#include <iostream>

#include "paper/options.h"
#include "paper/run.h"

int main(int argc, char** argv) {
  setenv("POCL_AFFINITY", "1", 0);  // as in falling_objects: read when OpenCL starts
  const auto parsed = paper::parse_options(argc, argv, std::cout, std::cerr);
  return parsed.exit_code ? *parsed.exit_code : paper::run(parsed.options);
}
