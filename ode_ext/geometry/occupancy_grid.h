// SPDX-License-Identifier: BSD-3-Clause
// A grid over a mesh that knows which cells its surface may touch and, of a closed mesh, which are
// wholly outside it. A vertex in such a cell cannot be inside the mesh, so it needs no ray.
// Conservative: a cell is "outside" only if it does not touch the surface and is connected to the
// border by such cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/vec.h"

namespace ode_ext {

struct OccupancyGrid {
  std::array<std::uint32_t, 3> cells{};  // 0: no grid
  Vec3f origin{};
  Vec3f cells_per_meter{};
  // A bit per cell, x fastest.
  std::vector<std::uint32_t> bits;     // 1: inside or at the surface; empty if the mesh is open
  std::vector<std::uint32_t> surface;  // 1: the surface may touch it
};

// `margin` [m]: how far from the surface a cell still counts as touching it.
OccupancyGrid build_occupancy_grid(const std::vector<Vec3f>& vertices,
                                   const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                   Vec3f lo, Vec3f hi, float margin, bool closed);

// Whether a point may be inside the mesh. True for everything if there is no grid, or the mesh is
// open.
bool may_be_inside(const OccupancyGrid& grid, Vec3f point);

}  // namespace ode_ext
