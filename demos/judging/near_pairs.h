// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/vector.h"

namespace falling_objects {

struct Ball {
  ode_ext::oracle::Vector middle;  // [m]; one that is not finite is near nothing
  double radius;                   // [m], > 0
};

// All pairs of balls that touch or overlap, each with the smaller index first, in ascending order.
// Takes time by how many balls and pairs there are, whatever their sizes.
std::vector<std::array<std::size_t, 2>> near_pairs(std::span<const Ball> balls);

}  // namespace falling_objects
