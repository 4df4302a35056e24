// SPDX-License-Identifier: BSD-3-Clause
// How far it is at least from a point to a cell of the occupancy grid that is not outside: a whole
// run of vertices is dismissed by one look. Blocks of 4 x 4 x 4 cells, one distance each.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/occupancy_grid.h"
#include "geometry/vec.h"

namespace ode_ext {

inline constexpr std::uint32_t kBlockCells = 4;

struct ClearanceGrid {
  std::array<std::uint32_t, 3> blocks{};  // 0: no grid
  float block_side = 0;                   // [m], the shortest side of a block
  // x fastest: steps (along axes and diagonals) to the nearest block that is not wholly outside.
  std::vector<std::uint8_t> steps;
};

ClearanceGrid build_clearance_grid(const OccupancyGrid& grid);

// No point within the returned distance [m] of `point` may be inside the mesh; negative or 0:
// nothing is known. 0 if there is no grid.
float clearance(const ClearanceGrid& clearance, const OccupancyGrid& grid, Vec3f point);

}  // namespace ode_ext
