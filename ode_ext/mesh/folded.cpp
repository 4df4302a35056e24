// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/folded.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "mesh/corners.h"

namespace ode_ext {
namespace {

// By the coordinates that the program gave, which are what was rounded.
bool is_needle(const Corners& corners) {
  double largest = 0;
  for (const Vec3d& corner : corners)
    for (const double x : {corner.x, corner.y, corner.z}) largest = std::max(largest, std::abs(x));
  return height(corners) <= kCornerRounding * largest;
}

}  // namespace

void leave_out_folded(WeldedMesh& mesh) {
  const std::vector<Triangle>& triangles = mesh.triangles;
  std::vector<bool> is_folded(triangles.size());
  std::size_t count = 0;
  for (std::size_t first = 0, last = 0; first < triangles.size(); first = last) {
    last = end_of_same_corners(triangles, first);
    if (last - first < 2 || !is_needle(corners_of(mesh.vertices, triangles[first]))) continue;
    // As many of one winding, which come first, as of the other.
    std::size_t other = first;
    while (other < last && triangles[other] == triangles[first]) ++other;
    const std::size_t pairs = std::min(other - first, last - other);
    for (std::size_t i = 0; i < pairs; ++i) is_folded[first + i] = is_folded[other + i] = true;
    count += 2 * pairs;
  }
  if (count != 0 && count != triangles.size()) leave_out(is_folded, mesh);
}

}  // namespace ode_ext
