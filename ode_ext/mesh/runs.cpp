// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/runs.h"

#include <algorithm>

#include "mesh/both.h"
#include "mesh/box.h"

namespace ode_ext {
namespace {

struct Point {
  Vec3f place;
  std::uint32_t index;
};
using Iterator = std::vector<Point>::iterator;

// A thread takes tens of microseconds to start, a point about a tenth of one.
constexpr std::size_t kPointsAThread = 32768;

// Halves the points across the longest side of their box until a run is left, as a k-d tree
// (Bentley 1975) does, but at multiples of a run, and of so many runs together as long as there are
// several: the order decides between equal contacts, so it is not changed lightly.
void split(Iterator first, Iterator last, std::size_t threads) {
  for (;;) {
    const auto count = static_cast<std::uint32_t>(last - first);
    if (count <= kRunLength) {
      // nth_element leaves them in an order of its own.
      std::sort(first, last, [](const Point& a, const Point& b) { return a.index < b.index; });
      return;
    }
    const std::uint32_t several = kRunLength * kRunsTogether;
    const std::uint32_t unit = count > several ? several : kRunLength;
    // The nearest to a half that leaves something on both sides.
    const std::uint32_t left = std::max(1u, (count / 2 + unit / 2) / unit) * unit;
    Box box = empty_box();
    for (Iterator i = first; i != last; ++i) box = grown(box, i->place);
    const Vec3d size = extent(box);
    const std::size_t axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto before = [axis](const Point& a, const Point& b) {
      for (const std::size_t k : {axis, (axis + 1) % 3, (axis + 2) % 3})
        if (a.place[k] != b.place[k]) return a.place[k] < b.place[k];
      return a.index < b.index;
    };
    std::nth_element(first, first + left, last, before);
    if (threads > 1) {
      const std::size_t half = threads / 2;
      do_both(
          threads, [=] { split(first, first + left, half); },
          [=] { split(first + left, last, threads - half); });
      return;
    }
    split(first, first + left, 1);
    first += left;
  }
}

}  // namespace

std::vector<std::uint32_t> order_into_runs(const std::vector<Vec3f>& points) {
  std::vector<Point> all;
  all.reserve(points.size());
  for (const Vec3f& place : points) all.push_back({place, static_cast<std::uint32_t>(all.size())});
  split(all.begin(), all.end(), worthwhile_threads(all.size(), kPointsAThread));
  std::vector<std::uint32_t> order;
  order.reserve(all.size());
  for (const Point& point : all) order.push_back(point.index);
  return order;
}

}  // namespace ode_ext
