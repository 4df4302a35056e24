// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/runs.h"

#include <algorithm>
#include <numeric>

#include "geometry/box.h"

namespace ode_ext {
namespace {

using Iterator = std::vector<std::uint32_t>::iterator;

// Halves the points across the longest side of their box until a run is left, as a k-d tree
// (Bentley 1975) does, but at multiples of a run, and of a group as long as there are several.
void split(const std::vector<Vec3f>& points, Iterator first, Iterator last) {
  for (;;) {
    const auto count = static_cast<std::uint32_t>(last - first);
    if (count <= kRunLength) {
      std::sort(first, last);  // nth_element leaves them in an order of its own
      return;
    }
    const std::uint32_t group = kRunLength * kRunsPerGroup;
    const std::uint32_t unit = count > group ? group : kRunLength;
    // The nearest to a half that leaves something on both sides.
    const std::uint32_t left = std::max(1u, (count / 2 + unit / 2) / unit) * unit;
    Box box = empty_box();
    for (Iterator i = first; i != last; ++i) box = grown(box, points[*i]);
    const Vec3d size = extent(box);
    const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
      const Vec3f p = points[a], q = points[b];
      for (const std::size_t k : {axis, (axis + 1) % 3, (axis + 2) % 3})
        if (p[k] != q[k]) return p[k] < q[k];
      return a < b;
    };
    std::nth_element(first, first + left, last, before);
    split(points, first, first + left);
    first += left;
  }
}

}  // namespace

std::vector<std::uint32_t> order_into_runs(const std::vector<Vec3f>& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  split(points, order.begin(), order.end());
  return order;
}

}  // namespace ode_ext
