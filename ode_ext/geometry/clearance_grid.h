// SPDX-License-Identifier: BSD-3-Clause
// How far it is at least from a point to the surface of a mesh: a vertex or a whole run of them is
// dismissed by one look. Blocks of 2 x 2 x 2 cells of the occupancy grid, each with the
// distance of its centre.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/occupancy_grid.h"
#include "geometry/vec.h"

namespace ode_ext {

inline constexpr std::uint32_t kBlockCells = 2;

struct ClearanceGrid {
  std::array<std::uint32_t, 3> blocks{};  // 0: no grid
  float step = 0;                         // [m]
  // x fastest: how far it is at least from the centre of a block to the surface, in steps; positive
  // outside, negative where the mesh may be around it.
  std::vector<std::int8_t> steps;
};

ClearanceGrid build_clearance_grid(const OccupancyGrid& grid);

// No point within the absolute value of this [m] of `point` is on the surface of the mesh. Positive
// outside, so that no point within it is inside either. 0: nothing is known.
float clearance(const ClearanceGrid& clearance, const OccupancyGrid& grid, Vec3f point);

}  // namespace ode_ext
