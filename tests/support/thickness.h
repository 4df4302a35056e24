// SPDX-License-Identifier: BSD-3-Clause
// How thick a body is, as the reduction of contacts asks it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/mesh_makers.h"

namespace ode_ext::test {

// [m] Half of it across a normal, by the half extents of its box: of those axes that the normal is
// not within 26 degrees of, along the one that it is thinnest along.
inline double half_thickness_across(const Point& half, const Point& normal) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
    if (std::fabs(normal[k]) <= 0.9) least = std::min(least, half[k]);
  return least;
}

}  // namespace ode_ext::test
