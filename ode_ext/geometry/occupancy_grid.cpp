// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/occupancy_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/box.h"
#include "geometry/triangle_box.h"

namespace ode_ext {
namespace {

// A cell that touches the surface costs rays that hit nothing, so cells are small: halving their
// side halves those rays. Building the grid is to stay a fraction of building the BVH, hence the
// budget per triangle; it is spread over the box in cubes.
constexpr double kCellsPerTriangle = 256;
constexpr double kFewestCells = 4096;   // 16 cubed
constexpr double kMostCells = 1 << 22;  // 512 KiB
constexpr double kLongestSide = 512;    // [cells], of a box with a side of no length

// Each cell in the box of a triangle is looked at, for slabs likewise (surface_slabs.cpp). A
// surface that is cut evenly has some 50 of them a triangle; long triangles that lie askew have as
// many as there are cells, which is no fraction of anything: they get fewer cells.
constexpr double kMostLooks = 1024;  // [cells] a triangle, on average
constexpr double kFewLooks = 1 << 20;

// The cell of a point is computed in float by a subtraction, a factor that is itself rounded, and a
// multiplication: off by at most 3 * 2^-24 of the side. Surface cells are widened by more, and the
// upper face of the box stays within the last cell although cells_per_meter is rounded.
constexpr double kIndexSlack = 0x1p-20;

// Beyond this the float arithmetic of cell indices over- or underflows.
constexpr double kLargestSide = 0x1p100;  // [m]
constexpr double kSmallestSide = 0x1p-100;

using Cell = std::array<std::int64_t, 3>;
using Triangle = std::array<std::uint32_t, 3>;

class GridBuilder {
 public:
  // False if the box has no size that a grid can be laid over.
  bool lay_over(Vec3f lo, Vec3f hi, double margin, const std::vector<Vec3f>& vertices,
                const std::vector<Triangle>& triangles) {
    const Vec3d size = extent({lo, hi});
    const double longest = std::max({size.x, size.y, size.z});
    if (!(longest >= kSmallestSide && longest <= kLargestSide)) return false;
    const auto count = static_cast<double>(triangles.size());
    double budget = std::clamp(kCellsPerTriangle * count, kFewestCells, kMostCells);
    const auto cube_for = [&](double cells) {
      return std::max(std::cbrt(size.x / cells * size.y * size.z), longest / kLongestSide);
    };
    while (budget > kFewestCells &&
           cells_in_boxes(vertices, triangles, cube_for(budget)) > kMostLooks * count + kFewLooks)
      budget = std::max(kFewestCells, budget / 2);
    const double cube = cube_for(budget);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      grid_.origin[axis] = rounded_down(lo[axis] - margin);
      side_[axis] = (double{hi[axis]} - grid_.origin[axis]) + margin;
      // Of the size, not the side: far from the frame's origin rounding the grid's origin may move
      // it by more than the mesh is wide, which may make cells longer but not more.
      const double cells = std::max(1.0, std::round(size[axis] / cube));
      cells_[axis] = static_cast<std::int64_t>(cells);
      grid_.cells[axis] = static_cast<std::uint32_t>(cells_[axis]);
      const auto per_meter = static_cast<float>((1 - kIndexSlack) * cells / side_[axis]);
      if (!std::isnormal(per_meter)) return false;
      grid_.cells_per_meter[axis] = per_meter;
      half_size_[axis] = 0.5 / per_meter + margin + kIndexSlack * side_[axis];
    }
    surface_.resize(static_cast<std::size_t>(cells_[0] * cells_[1] * cells_[2]));
    outside_.resize(surface_.size());
    return true;
  }

  void add_triangle(Vec3f a, Vec3f b, Vec3f c) {
    const Vec3d origin(grid_.origin);  // first of all, or far coordinates would swallow the margin
    const std::array<Vec3d, 3> corners{Vec3d(a) - origin, Vec3d(b) - origin, Vec3d(c) - origin};
    const Vec3d lo = min(min(corners[0], corners[1]), corners[2]);
    const Vec3d hi = max(max(corners[0], corners[1]), corners[2]);
    Cell first{}, last{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double slack = half_size_[axis] - 0.5 / grid_.cells_per_meter[axis];
      first[axis] = clamped_cell(axis, lo[axis] - slack);
      last[axis] = clamped_cell(axis, hi[axis] + slack);
    }
    for (std::int64_t z = first[2]; z <= last[2]; ++z) {
      for (std::int64_t y = first[1]; y <= last[1]; ++y) {
        for (std::int64_t x = first[0]; x <= last[0]; ++x) {
          const Cell cell{x, y, z};
          if (!surface_[index(cell)] &&
              triangle_overlaps_box(corners, cell_centre(cell), half_size_)) {
            surface_[index(cell)] = true;
          }
        }
      }
    }
  }

  // Everything beyond the grid is outside, so the cells of its border are where outside comes in.
  void flood_outside() {
    std::vector<Cell> stack;
    const auto visit = [&](const Cell& cell) {
      if (surface_[index(cell)] || outside_[index(cell)]) return;
      outside_[index(cell)] = true;
      stack.push_back(cell);
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      Cell cell{};
      for (cell[u] = 0; cell[u] < cells_[u]; ++cell[u]) {
        for (cell[v] = 0; cell[v] < cells_[v]; ++cell[v]) {
          cell[axis] = 0;
          visit(cell);
          cell[axis] = cells_[axis] - 1;
          visit(cell);
        }
      }
    }
    while (!stack.empty()) {
      const Cell cell = stack.back();
      stack.pop_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const std::int64_t step : {-1, 1}) {
          Cell next = cell;
          next[axis] += step;
          if (next[axis] >= 0 && next[axis] < cells_[axis]) visit(next);
        }
      }
    }
  }

  OccupancyGrid finish(bool closed) {
    const auto packed = [](const std::vector<bool>& cells, bool value) {
      std::vector<std::uint32_t> bits((cells.size() + 31) / 32);
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (cells[i] == value) bits[i / 32] |= 1u << (i % 32);
      return bits;
    };
    if (closed) grid_.bits = packed(outside_, false);
    grid_.surface = packed(surface_, true);
    return std::move(grid_);
  }

 private:
  // About how many cells of this side the boxes of all triangles have together.
  static double cells_in_boxes(const std::vector<Vec3f>& vertices,
                               const std::vector<Triangle>& triangles, double side) {
    double sum = 0;
    for (const Triangle& triangle : triangles) {
      Box box = empty_box();
      for (const std::uint32_t corner : triangle) box = grown(box, vertices[corner]);
      const Vec3d size = extent(box);
      sum += (size.x / side + 1) * (size.y / side + 1) * (size.z / side + 1);
    }
    return sum;
  }

  static float rounded_down(double value) {
    const auto rounded = static_cast<float>(value);
    if (rounded <= value) return rounded;
    return std::nextafter(rounded, -std::numeric_limits<float>::infinity());
  }

  std::size_t index(const Cell& cell) const {
    return static_cast<std::size_t>((cell[2] * cells_[1] + cell[1]) * cells_[0] + cell[0]);
  }

  std::int64_t clamped_cell(std::size_t axis, double offset) const {
    const double cell = std::floor(offset * grid_.cells_per_meter[axis]);
    return static_cast<std::int64_t>(std::clamp(cell, 0.0, static_cast<double>(cells_[axis] - 1)));
  }

  Vec3d cell_centre(const Cell& cell) const {
    Vec3d result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result[axis] = (static_cast<double>(cell[axis]) + 0.5) / grid_.cells_per_meter[axis];
    }
    return result;
  }

  OccupancyGrid grid_;
  Cell cells_{};
  Vec3d side_{};       // [m]
  Vec3d half_size_{};  // of a cell, widened [m]
  std::vector<bool> surface_, outside_;
};

}  // namespace

OccupancyGrid build_occupancy_grid(const std::vector<Vec3f>& vertices,
                                   const std::vector<std::array<std::uint32_t, 3>>& triangles,
                                   Vec3f lo, Vec3f hi, float margin, bool closed) {
  GridBuilder builder;
  if (!builder.lay_over(lo, hi, margin, vertices, triangles)) return {};
  for (const auto& triangle : triangles) {
    builder.add_triangle(vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]);
  }
  if (closed) builder.flood_outside();
  return builder.finish(closed);
}

bool may_be_inside(const OccupancyGrid& grid, Vec3f point) {
  if (grid.bits.empty()) return true;
  std::size_t index = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    const float cell = std::floor((point[axis] - grid.origin[axis]) * grid.cells_per_meter[axis]);
    // Compared before it is converted: far points do not fit into an int.
    if (!(cell >= 0 && cell < static_cast<float>(grid.cells[axis]))) return false;
    index = index * grid.cells[axis] + static_cast<std::size_t>(cell);
  }
  return (grid.bits[index / 32] >> (index % 32) & 1) != 0;
}

}  // namespace ode_ext
