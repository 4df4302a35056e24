// SPDX-License-Identifier: BSD-3-Clause
// An order in which every run of points is a compact cluster.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/vec.h"

namespace ode_ext {

inline constexpr std::uint32_t kRunLength = 16;    // one work-group, or a part of it
inline constexpr std::uint32_t kRunsTogether = 8;  // so many runs are near one another, too

// The indices of the points in that order: place i holds point order[i]. Depends on nothing but the
// points, and between equal ones on their indices.
std::vector<std::uint32_t> order_into_runs(const std::vector<Vec3f>& points);

}  // namespace ode_ext
