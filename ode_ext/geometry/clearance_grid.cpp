// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/clearance_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ode_ext {
namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();

// A quarter of a cell, so that a byte reaches 31 cells.
constexpr double kStepsPerCell = 4;
constexpr double kMostSteps = 127;

// What a kernel's arithmetic may be off by: relative, by a dozen roundings of 2^-24, and in the
// index of a cell (occupancy_grid.cpp: 2^-20 of the side of the grid, of at most 2^9 cells).
constexpr double kRelativeSlack = 0x1p-20;
constexpr double kCellSlack = 0x1p-11;  // [cells]

using Counts = std::array<std::size_t, 3>;

// Squared distances, in units of the longest side of a cell, x fastest.
struct Field {
  Counts counts{};
  std::vector<float> values;
};

// A field with one value per cell along `axis` becomes one with a value per block: the least of
// what the cells have plus the squared distance along the axis from the block's centre to them.
// Over all three axes that is the squared Euclidean distance, the square of which falls into
// axes (Saito and Toriwaki 1994).
Field along(std::size_t axis, double side, const Field& cells) {
  Field blocks{cells.counts, {}};
  blocks.counts[axis] = (cells.counts[axis] + kBlockCells - 1) / kBlockCells;
  blocks.values.assign(blocks.counts[0] * blocks.counts[1] * blocks.counts[2], kFar);
  std::size_t stride = 1;
  for (std::size_t k = 0; k < axis; ++k) stride *= cells.counts[k];
  const std::size_t length = cells.counts[axis];
  const std::size_t results = blocks.counts[axis];
  std::vector<float> line(length), squares(length);
  for (std::size_t k = 0; k < length; ++k) {
    const double away = side * static_cast<double>(k);
    squares[k] = static_cast<float>(away * away);
  }
  for (std::size_t row = 0; row < cells.values.size() / length; ++row) {
    const std::size_t from = row / stride * stride * length + row % stride;
    const std::size_t to = row / stride * stride * results + row % stride;
    bool any = false;
    for (std::size_t i = 0; i < length; ++i) {
      line[i] = cells.values[from + i * stride];
      any = any || line[i] < kFar;
    }
    if (!any) continue;
    for (std::size_t block = 0; block < results; ++block) {
      const std::size_t centre = block * kBlockCells + kBlockCells / 2;  // a cell begins here
      float least = kFar;
      for (std::size_t k = 0; k < length; ++k) {
        if (squares[k] >= least) break;
        if (centre + k < length) least = std::min(least, squares[k] + line[centre + k]);
        if (centre >= k + 1) least = std::min(least, squares[k] + line[centre - k - 1]);
      }
      blocks.values[to + block * stride] = least;
    }
  }
  return blocks;
}

static_assert(kBlockCells % 2 == 0, "the centre of a block is a corner of cells");

bool is_set(const std::vector<std::uint32_t>& bits, std::size_t i) {
  return (bits[i / 32] >> (i % 32) & 1) != 0;
}

}  // namespace

ClearanceGrid build_clearance_grid(const OccupancyGrid& grid) {
  ClearanceGrid result;
  if (grid.surface.empty()) return result;
  Field field;
  for (std::size_t axis = 0; axis < 3; ++axis) field.counts[axis] = grid.cells[axis];
  field.values.resize(field.counts[0] * field.counts[1] * field.counts[2]);
  for (std::size_t i = 0; i < field.values.size(); ++i)
    field.values[i] = is_set(grid.surface, i) ? 0 : kFar;
  std::array<double, 3> sides{};
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sides[axis] = 1 / static_cast<double>(grid.cells_per_meter[axis]);
    longest = std::max(longest, sides[axis]);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) field = along(axis, sides[axis] / longest, field);
  std::copy(field.counts.begin(), field.counts.end(), result.blocks.begin());
  result.step = static_cast<float>(longest / kStepsPerCell);
  result.steps.reserve(field.values.size());
  for (std::size_t z = 0; z < field.counts[2]; ++z)
    for (std::size_t y = 0; y < field.counts[1]; ++y)
      for (std::size_t x = 0; x < field.counts[0]; ++x) {
        const float squared = field.values[result.steps.size()];
        const double known = std::sqrt(squared) * (1 - kRelativeSlack) - kCellSlack;
        const double steps = std::clamp(std::floor(kStepsPerCell * known), 0.0, kMostSteps);
        // No cell about the centre is of the surface, or there are no steps: all are of a kind.
        const std::size_t cell =
            (z * kBlockCells * grid.cells[1] + y * kBlockCells) * grid.cells[0] + x * kBlockCells;
        const bool outside = !grid.bits.empty() && !is_set(grid.bits, cell);
        result.steps.push_back(static_cast<std::int8_t>(outside ? steps : -steps));
      }
  return result;
}

float clearance(const ClearanceGrid& clearance, const OccupancyGrid& grid, Vec3f point) {
  if (clearance.steps.empty()) return 0;
  std::size_t index = 0;
  float within2 = 0, beyond2 = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    const float cells = static_cast<float>(grid.cells[axis]);
    const float cell = (point[axis] - grid.origin[axis]) * grid.cells_per_meter[axis];
    const float nearest = std::min(std::max(cell, 0.0f), cells);
    const std::size_t block = std::min(static_cast<std::size_t>(nearest) / kBlockCells,
                                       std::size_t{clearance.blocks[axis]} - 1);
    const float centre = static_cast<float>(block * kBlockCells + kBlockCells / 2);
    const float steps_per_cell = 1 / (grid.cells_per_meter[axis] * clearance.step);
    const float within = (nearest - centre) * steps_per_cell;
    // Bounded, so that its square is finite; what is nearer than it is still is.
    const float beyond = std::min(std::fabs(cell - nearest) * steps_per_cell, 1e18f);
    within2 += within * within;
    beyond2 += beyond * beyond;
    index = index * clearance.blocks[axis] + block;
  }
  const float steps = clearance.steps[index];
  const float known = std::max(std::fabs(steps) - std::sqrt(within2), 0.0f);
  if (beyond2 == 0) return (steps < 0 ? -known : known) * clearance.step;
  // The mesh is within the grid: seen from beyond it, it is at least as far as from the nearest
  // point of the grid, at more than a right angle.
  return std::sqrt(beyond2 + known * known) * clearance.step;
}

}  // namespace ode_ext
