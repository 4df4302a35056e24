// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/clearance_grid.h"

#include <algorithm>
#include <cmath>

namespace ode_ext {
namespace {

// Chessboard distance by two sweeps (Rosenfeld and Pfaltz 1968): each cell takes the least of its
// already swept neighbours plus one. Exact for this metric.
void sweep(ClearanceGrid& grid) {
  const auto nx = static_cast<int>(grid.blocks[0]);
  const auto ny = static_cast<int>(grid.blocks[1]);
  const auto nz = static_cast<int>(grid.blocks[2]);
  const auto at = [&](int x, int y, int z) -> std::uint8_t& {
    return grid.steps[static_cast<std::size_t>((z * ny + y) * nx + x)];
  };
  const auto relax = [&](int x, int y, int z, int direction) {
    int least = at(x, y, z);
    for (int dz = -1; dz <= 0; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          if (dz == 0 && (dy > 0 || (dy == 0 && dx >= 0))) continue;  // not swept yet
          const int u = x + direction * dx;
          const int v = y + direction * dy;
          const int w = z + direction * dz;
          if (u < 0 || v < 0 || w < 0 || u >= nx || v >= ny || w >= nz) continue;
          least = std::min(least, at(u, v, w) + 1);
        }
    at(x, y, z) = static_cast<std::uint8_t>(std::min(least, 255));
  };
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) relax(x, y, z, 1);
  for (int z = nz; z-- > 0;)
    for (int y = ny; y-- > 0;)
      for (int x = nx; x-- > 0;) relax(x, y, z, -1);
}

}  // namespace

ClearanceGrid build_clearance_grid(const OccupancyGrid& grid) {
  ClearanceGrid result;
  if (grid.bits.empty()) return result;
  float shortest = INFINITY;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.blocks[axis] = (grid.cells[axis] + kBlockCells - 1) / kBlockCells;
    shortest = std::min(shortest, 1 / grid.cells_per_meter[axis]);
  }
  // Down by more than the rounding of a cell index (occupancy_grid.cpp: 2^-20 of the side).
  result.block_side = static_cast<float>(kBlockCells) * shortest * (1 - 0x1p-10f);
  result.steps.assign(std::size_t{result.blocks[0]} * result.blocks[1] * result.blocks[2], 255);
  std::size_t cell = 0;
  for (std::uint32_t z = 0; z < grid.cells[2]; ++z)
    for (std::uint32_t y = 0; y < grid.cells[1]; ++y)
      for (std::uint32_t x = 0; x < grid.cells[0]; ++x, ++cell)
        if ((grid.bits[cell / 32] >> (cell % 32) & 1) != 0)
          result.steps[(std::size_t{z / kBlockCells} * result.blocks[1] + y / kBlockCells) *
                           result.blocks[0] +
                       x / kBlockCells] = 0;
  sweep(result);
  return result;
}

float clearance(const ClearanceGrid& clearance, const OccupancyGrid& grid, Vec3f point) {
  if (clearance.steps.empty()) return 0;
  // A point beyond the grid asks at the nearest block and gives back what it was moved by.
  std::size_t index = 0;
  float moved = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    const float cells = static_cast<float>(grid.cells[axis]);
    const float cell = (point[axis] - grid.origin[axis]) * grid.cells_per_meter[axis];
    const float nearest = std::min(std::max(cell, 0.0f), cells - 1);
    moved += std::fabs(cell - nearest) / grid.cells_per_meter[axis];
    index = index * clearance.blocks[axis] + static_cast<std::size_t>(nearest) / kBlockCells;
  }
  return (static_cast<float>(clearance.steps[index]) - 1) * clearance.block_side - moved;
}

}  // namespace ode_ext
