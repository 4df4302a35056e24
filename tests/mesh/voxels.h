// SPDX-License-Identifier: BSD-3-Clause
// Worlds of unit cubes, each with faces of its own: where two are side by side there are walls.
#pragma once

#include <array>
#include <random>
#include <set>

#include "mesh/shapes.h"

namespace ode_ext::shapes {

using Cell = std::array<int, 3>;

inline TriangleSoup voxels(const std::set<Cell>& cells) {
  TriangleSoup soup;
  for (const auto& [i, j, k] : cells) {
    const Vec3f lo{static_cast<float>(i), static_cast<float>(j), static_cast<float>(k)};
    soup = joined(std::move(soup), box(lo, lo + Vec3f{1, 1, 1}));
  }
  return soup;
}

// Each of size^3 cells with a chance of a half.
inline std::set<Cell> random_cells(int size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::set<Cell> cells;
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j)
      for (int k = 0; k < size; ++k)
        if (random() % 2 == 0) cells.insert({i, j, k});
  return cells;
}

// How many sides of cells have no other beside them.
inline std::size_t outer_sides(const std::set<Cell>& cells) {
  std::size_t count = 0;
  for (const Cell& cell : cells)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int step : {-1, 1}) {
        Cell beside = cell;
        beside[axis] += step;
        count += cells.contains(beside) ? 0 : 1;
      }
  return count;
}

inline Cell cell_of(Vec3d point) {
  Cell cell{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    cell[axis] = static_cast<int>(std::floor(point[axis]));
  return cell;
}

}  // namespace ode_ext::shapes
