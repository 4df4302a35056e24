// SPDX-License-Identifier: BSD-3-Clause
// Which triangles lie side by side.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"

namespace ode_ext {

// The triangle across the edge from corner k to corner (k + 1) % 3; kNone where those at the edge
// are not all pairs that run it in opposite directions (edge_pairs.h).
using Neighbours = std::array<std::uint32_t, 3>;

std::vector<Neighbours> neighbours(std::size_t triangle_count,
                                   const std::vector<HalfEdge>& half_edges);

}  // namespace ode_ext
