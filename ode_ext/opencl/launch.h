// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace ode_ext {

// How a step is launched. Kernels loop over their input whatever the grid, so this decides how long
// a step takes and never what it gives.
struct Launch {
  std::size_t groups;
  std::size_t local;  // work-items per group; explicit, since PoCL compiles a kernel anew for each

  friend bool operator<(const Launch& a, const Launch& b) { return a.groups < b.groups; }
};

}  // namespace ode_ext
