// SPDX-License-Identifier: BSD-3-Clause
// The irregular ground (GRAPP section 6): a bowl in a closed slab, so that it has an inside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "falling_objects/triangle_mesh.h"

namespace falling_objects {

class Ground {
 public:
  // A square of 2 * `half_size` [m] around the origin; what lands in it slides to the middle.
  Ground(double half_size, std::uint64_t seed);

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

  double half_size_;
  std::size_t cells_;  // along a side
  double cell_;        // edge of a cell [m]
  std::vector<double> heights_;
  TriangleMesh mesh_;
};

}  // namespace falling_objects
