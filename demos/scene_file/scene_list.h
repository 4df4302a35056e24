// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>

namespace falling_objects {

// The scenes that come with the program, and the shapes with their parameters.
void print_scenes(std::ostream& out);

}  // namespace falling_objects
