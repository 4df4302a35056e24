// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/surface_slabs.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace ode_ext {
namespace {

// The index of a cell, and with it where in its block a point is, is off by at most 2^-20 of the
// side of the grid (occupancy_grid.cpp), which is 2^-11 of at most 2^9 cells.
constexpr double kIndexSlack = 0x1p-20;
constexpr double kCellSlack = 0x1p-11;

// [cells] The farther a slab reaches, the thicker it is where the surface bends.
constexpr double kReach = 1;

// A slab thicker than it reaches tells no more than the clearance does.
constexpr double kThickest = 2;  // of the reach

// How many points beyond a slab are asked whether they are outside.
constexpr int kSamples = 8;

struct DoubleBox {
  Vec3d lo, hi;
};

// A convex polygon: a triangle, cut by the six sides of a box.
class Polygon {
 public:
  Polygon(Vec3d a, Vec3d b, Vec3d c) : corners_{a, b, c}, count_(3) {}

  void clip(const DoubleBox& box) {
    for (std::size_t axis = 0; axis < 3 && count_ > 0; ++axis) {
      clip(axis, 1, box.hi[axis]);
      clip(axis, -1, -box.lo[axis]);
    }
  }

  const Vec3d* begin() const { return corners_.data(); }
  const Vec3d* end() const { return corners_.data() + count_; }

  // Twice its area, along its normal.
  Vec3d area() const {
    Vec3d sum;
    for (std::size_t i = 1; i + 1 < count_; ++i)
      sum = sum + cross(corners_[i] - corners_[0], corners_[i + 1] - corners_[0]);
    return sum;
  }

 private:
  // Keeps what is at most `limit` along the axis (Sutherland and Hodgman 1974).
  void clip(std::size_t axis, double sign, double limit) {
    const auto above = [&](const Vec3d& corner) { return sign * corner[axis] > limit; };
    if (std::none_of(begin(), end(), above)) return;
    std::array<Vec3d, 12> kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const Vec3d from = corners_[i], to = corners_[(i + 1) % count_];
      const double height = sign * from[axis] - limit, next = sign * to[axis] - limit;
      if (!above(from)) kept[count++] = from;
      if (above(from) != above(to)) {
        Vec3d cut = from + height / (height - next) * (to - from);
        cut[axis] = sign * limit;
        kept[count++] = cut;
      }
    }
    corners_ = kept;
    count_ = count;
  }

  std::array<Vec3d, 12> corners_;  // each side of the box adds one, rounding now and then another
  std::size_t count_;
};

class SlabBuilder {
 public:
  SlabBuilder(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
              const Bvh& bvh, const OccupancyGrid& grid, double margin)
      : vertices_(vertices), triangles_(triangles), bvh_(bvh), grid_(grid), origin_(grid.origin) {
    reach_ = INFINITY;
    double longest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cell_[axis] = 1 / static_cast<double>(grid.cells_per_meter[axis]);
      reach_ = std::min(reach_, kReach * cell_[axis]);
      longest = std::max(longest, cell_[axis] * grid.cells[axis]);
    }
    half_block_ = (0.5 * kBlockCells) * cell_;
    half_size_ = half_block_ + Vec3d{reach_, reach_, reach_} + kCellSlack * cell_;
    padding_ = margin + kIndexSlack * longest;
  }

  double reach() const { return reach_; }
  double half_diagonal() const { return length(half_block_); }

  std::optional<SurfaceSlab> slab(std::array<std::size_t, 3> block) {
    // Coordinates from here on are relative to the origin of the grid: of the size of the mesh.
    Vec3d centre;
    for (std::size_t axis = 0; axis < 3; ++axis)
      centre[axis] =
          (static_cast<double>(block[axis]) * kBlockCells + kBlockCells / 2) * cell_[axis];
    const DoubleBox around{centre - half_size_, centre + half_size_};
    const Vec3d area = collect(around);
    const double size = length(area);
    if (!(size > 0)) return {};
    Vec3d normal = (1 / size) * area;
    double lo = INFINITY, hi = -INFINITY;
    for (const Vec3d& corner : corners_) {
      const double height = dot(normal, corner - centre);
      lo = std::min(lo, height);
      hi = std::max(hi, height);
    }
    if (!(hi - lo <= kThickest * reach_)) return {};
    bool outside = is_outside_beyond(centre, normal, hi);
    if (!outside && is_outside_beyond(centre, Vec3d{} - normal, -lo)) {
      outside = true;
      normal = Vec3d{} - normal;
      std::swap(lo, hi);
      lo = -lo;
      hi = -hi;
    }
    return SurfaceSlab{Vec3f(normal), static_cast<float>(lo - padding_),
                       static_cast<float>(hi + padding_), outside ? 1u : 0u};
  }

 private:
  // The corners of the parts of the triangles within the box; returns the sum of their areas.
  Vec3d collect(const DoubleBox& around) {
    corners_.clear();
    Vec3d area;
    for (std::size_t n = 0; n < bvh_.nodes.size();) {
      const BvhNode& node = bvh_.nodes[n];
      const Vec3d lo = Vec3d(node.lo) - origin_, hi = Vec3d(node.hi) - origin_;
      bool apart = false, inside = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        apart = apart || lo[axis] > around.hi[axis] || hi[axis] < around.lo[axis];
        inside = inside && lo[axis] >= around.lo[axis] && hi[axis] <= around.hi[axis];
      }
      if (apart) {
        n = node.skip;
        continue;
      }
      for (std::uint32_t k = node.leaf >> 3; k < (node.leaf >> 3) + (node.leaf & 7); ++k) {
        const Triangle& corners = triangles_[bvh_.order[k]];
        Polygon polygon(corner(corners[0]), corner(corners[1]), corner(corners[2]));
        if (!inside) polygon.clip(around);
        area = area + polygon.area();
        corners_.insert(corners_.end(), polygon.begin(), polygon.end());
      }
      ++n;
    }
    return area;
  }

  Vec3d corner(std::uint32_t vertex) const { return Vec3d(vertices_[vertex]) - origin_; }

  // What is within the box and above a height along the normal is convex and holds no surface, so
  // it is all inside or all outside: as any cell is that has a point of it and no surface.
  bool is_outside_beyond(Vec3d centre, Vec3d normal, double height) const {
    if (grid_.bits.empty()) return false;
    double farthest = INFINITY;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (normal[axis] != 0)
        farthest = std::min(farthest, half_size_[axis] / std::fabs(normal[axis]));
    for (int i = 1; i < kSamples; ++i) {
      const double along = height + i * (farthest - height) / kSamples;
      if (!(along > height)) return false;
      if (along < -farthest) continue;  // not in the box
      std::size_t index = 0;
      bool beyond = false;
      for (std::size_t axis = 3; axis-- > 0;) {
        const double cell = std::floor((centre[axis] + along * normal[axis]) / cell_[axis]);
        beyond = beyond || cell < 0 || cell >= grid_.cells[axis];
        if (!beyond) index = index * grid_.cells[axis] + static_cast<std::size_t>(cell);
      }
      if (beyond) return true;
      if ((grid_.surface[index / 32] >> (index % 32) & 1) != 0) continue;
      return (grid_.bits[index / 32] >> (index % 32) & 1) == 0;
    }
    return false;
  }

  const std::vector<Vec3f>& vertices_;
  const std::vector<Triangle>& triangles_;
  const Bvh& bvh_;
  const OccupancyGrid& grid_;
  Vec3d origin_;
  Vec3d cell_;        // [m]
  Vec3d half_block_;  // [m]
  Vec3d half_size_;   // of what is within reach of a block [m]
  double reach_;
  double padding_;  // [m]
  std::vector<Vec3d> corners_;
};

}  // namespace

SurfaceSlabs build_surface_slabs(const std::vector<Vec3f>& vertices,
                                 const std::vector<Triangle>& triangles, const Bvh& bvh,
                                 const OccupancyGrid& grid, const ClearanceGrid& clearance,
                                 float margin) {
  SurfaceSlabs result;
  if (clearance.steps.empty()) return result;
  SlabBuilder builder(vertices, triangles, bvh, grid, margin);
  result.reach = static_cast<float>(builder.reach());
  const std::size_t words = (clearance.steps.size() + 31) / 32;
  result.bits.resize(words);
  result.ranks.resize(words);
  // Farther away than this the clearance answers whatever a slab could.
  const double near = builder.half_diagonal() + builder.reach();
  std::size_t index = 0;
  for (std::size_t z = 0; z < clearance.blocks[2]; ++z)
    for (std::size_t y = 0; y < clearance.blocks[1]; ++y)
      for (std::size_t x = 0; x < clearance.blocks[0]; ++x, ++index) {
        if (index % 32 == 0)
          result.ranks[index / 32] = static_cast<std::uint32_t>(result.slabs.size());
        if (std::abs(clearance.steps[index]) * double{clearance.step} > near) continue;
        const std::optional<SurfaceSlab> slab = builder.slab({x, y, z});
        if (!slab) continue;
        result.bits[index / 32] |= 1u << (index % 32);
        result.slabs.push_back(*slab);
      }
  return result;
}

const SurfaceSlab* find_slab(const SurfaceSlabs& slabs, std::size_t block) {
  if (slabs.bits.empty()) return nullptr;
  const std::uint32_t word = slabs.bits[block / 32];
  const std::uint32_t bit = 1u << (block % 32);
  if ((word & bit) == 0) return nullptr;
  return &slabs.slabs[slabs.ranks[block / 32] +
                      static_cast<std::uint32_t>(std::popcount(word & (bit - 1)))];
}

}  // namespace ode_ext
