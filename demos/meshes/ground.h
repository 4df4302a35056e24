// SPDX-License-Identifier: BSD-3-Clause
// The irregular ground (GRAPP section 6), or none: a bowl in a closed slab, which has an inside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "meshes/triangle_mesh.h"

namespace falling_objects {

inline constexpr double kBowl = 0.6;  // height of the rim over half the size

class Ground {
 public:
  // None: its mesh is empty, nothing is below it, and nothing beyond its border.
  Ground() = default;
  // A square of 2 * `half_size` [m] around the origin; what lands in a bowl slides to the middle.
  Ground(double half_size, std::uint64_t seed, double steepness = kBowl);

  bool empty() const { return cells_ == 0; }

  const TriangleMesh& mesh() const { return mesh_; }
  double half_size() const { return half_size_; }
  // Of the mesh's surface at a place [m]; outside the square that of the nearest border.
  double height(double x, double y) const;
  // Greatest height within `radius` of a place [m].
  double highest_near(double x, double y, double radius) const;

 private:
  double corner_height(std::size_t i, std::size_t j) const {
    return heights_[j * (cells_ + 1) + i];
  }
  void make_mesh();

  double half_size_ = std::numeric_limits<double>::infinity();
  std::size_t cells_ = 0;  // along a side
  double cell_ = 0;        // edge of a cell [m]
  std::vector<double> heights_;
  TriangleMesh mesh_;
};

}  // namespace falling_objects
