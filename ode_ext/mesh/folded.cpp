// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/folded.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ode_ext {
namespace {

// Of the largest coordinate: twice what rounding to floats can move a corner by, which is half of
// 2^-23 along each axis.
constexpr double kFoldedHeight = 0x1p-22;

bool is_needle(const WeldedMesh& mesh, const Triangle& triangle) {
  const Vec3d a(mesh.vertices[triangle[0]]), b(mesh.vertices[triangle[1]]);
  const Vec3d c(mesh.vertices[triangle[2]]);
  double largest = 0;
  for (const Vec3d& corner : {a, b, c})
    for (const double x : {corner.x, corner.y, corner.z}) largest = std::max(largest, std::abs(x));
  const double longest = std::max({length(b - a), length(c - b), length(a - c)});
  return length(cross(b - a, c - a)) <= kFoldedHeight * largest * longest;
}

}  // namespace

void leave_out_folded(WeldedMesh& mesh) {
  const std::vector<Triangle>& triangles = mesh.triangles;
  std::vector<bool> is_folded(triangles.size());
  std::size_t count = 0;
  for (std::size_t first = 0, last = 0; first < triangles.size(); first = last) {
    for (last = first + 1;
         last < triangles.size() && have_same_corners(triangles[first], triangles[last]);)
      ++last;
    if (last - first < 2 || !is_needle(mesh, triangles[first])) continue;
    // As many of one winding as of the other.
    const auto is_of_first = [&](std::size_t i) { return triangles[i] == triangles[first]; };
    std::size_t same = 0;
    for (std::size_t i = first; i < last; ++i) same += is_of_first(i) ? 1 : 0;
    std::size_t left[2] = {std::min(same, last - first - same), 0};
    left[1] = left[0];
    for (std::size_t i = first; i < last; ++i) {
      std::size_t& of_winding = left[is_of_first(i) ? 0 : 1];
      if (of_winding == 0) continue;
      --of_winding;
      is_folded[i] = true;
      ++count;
    }
  }
  if (count != 0 && count != triangles.size()) leave_out(is_folded, mesh);
}

}  // namespace ode_ext
