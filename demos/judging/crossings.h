// SPDX-License-Identifier: BSD-3-Clause
// Which triangles cross a surface: in double precision, by the edges of either through the other,
// and with nothing of the collider's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/triangle_tree.h"

namespace falling_objects {

// An edge of one goes through the other. Triangles that only touch, or lie in one plane, do not.
bool triangles_cross(const ode_ext::oracle::Triangle& a, const ode_ext::oracle::Triangle& b);

// The triangles of a surface in the cells of a grid.
class CrossingFinder {
 public:
  explicit CrossingFinder(std::vector<ode_ext::oracle::Triangle> surface);

  bool crossed_by(const ode_ext::oracle::Triangle& triangle) const;

 private:
  using Cell = std::array<std::size_t, 3>;
  bool cells_of(const ode_ext::oracle::Triangle& triangle, Cell& first, Cell& last) const;
  std::size_t number(const Cell& cell) const {
    return (cell[2] * cells_[1] + cell[1]) * cells_[0] + cell[0];
  }

  std::vector<ode_ext::oracle::Triangle> surface_;
  ode_ext::oracle::Vector low_, high_;
  double cell_ = 0;  // edge of a cell [m]
  Cell cells_{};
  std::vector<std::vector<std::uint32_t>> in_cell_;
};

}  // namespace falling_objects
