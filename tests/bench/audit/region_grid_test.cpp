// SPDX-License-Identifier: BSD-3-Clause
// The region oracle counts by triangles and edges; a grid of points that are inside both meshes
// counts by neither.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "bench/audit/kinds.h"
#include "bench/audit/pair_audit.h"

namespace ode_ext::audit {
namespace {

using namespace test;

constexpr int kCells = 32;

// Connected sets of points in the box, which is that of `b`'s frame, inside both.
int count_by_points(const Shape& a, const Shape& b, const PosedPair& poses, const Point& low,
                    const Point& high) {
  std::vector<bool> inside;
  for (int i = 0; i < kCells * kCells * kCells; ++i) {
    const Point cell{i % kCells + 0.5, i / kCells % kCells + 0.5, i / kCells / kCells + 0.5};
    Point p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = low[k] + cell[k] / kCells * (high[k] - low[k]);
    const Point q = to_local(poses.a, to_world(poses.b, p));
    inside.push_back(b.solid.depth({p[0], p[1], p[2]}, 0) > 0 &&
                     a.solid.depth({q[0], q[1], q[2]}, 0) > 0);
  }
  int count = 0;
  for (int i = 0; i < static_cast<int>(inside.size()); ++i) {
    if (!inside[static_cast<std::size_t>(i)]) continue;
    ++count;
    std::vector<int> front{i};
    while (!front.empty()) {
      const int at = front.back();
      front.pop_back();
      if (!inside[static_cast<std::size_t>(at)]) continue;
      inside[static_cast<std::size_t>(at)] = false;
      const int x = at % kCells, y = at / kCells % kCells, z = at / kCells / kCells;
      for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            if (std::min({x + dx, y + dy, z + dz}) < 0) continue;
            if (std::max({x + dx, y + dy, z + dz}) >= kCells) continue;
            front.push_back(at + dx + kCells * (dy + kCells * dz));
          }
        }
      }
    }
  }
  return count;
}

// Points do not see what is smaller than their distance, and join what is closer: most counts must
// be equal, not all.
TEST(Regions, AreAsManyAsAGridOfPointsFindsInRandomPoses) {
  const std::vector<Kind> kinds = make_kinds();
  const auto mesh = [&](const char* name) {
    return std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.name == name; })
        ->mesh;
  };
  Random random(3);
  int looked = 0, equal = 0, several = 0;
  for (const auto& [first, second] : {std::pair("ring", "u_beam"), std::pair("star", "cube"),
                                      std::pair("u_beam", "u_beam"), std::pair("ring", "ring")}) {
    const Shape a(mesh(first)), b(mesh(second));
    for (int i = 0; i < 12; ++i) {
      const PosedPair poses = deep_pair(mesh(first), mesh(second), random);
      const auto regions =
          find_regions(a.graph, poses.a, b.graph, poses.b,
                       intersecting_triangles(a.surface, poses.a, b.surface, poses.b));
      if (regions.empty()) continue;
      Point low = regions[0].low, high = regions[0].high;
      for (const Region& region : regions) {
        for (std::size_t k = 0; k < 3; ++k) {
          low[k] = std::min(low[k], region.low[k]);
          high[k] = std::max(high[k], region.high[k]);
        }
      }
      const int points = count_by_points(a, b, poses, low, high);
      ++looked;
      several += regions.size() > 1;
      equal += points == static_cast<int>(regions.size());
    }
  }
  EXPECT_GT(looked, 40);
  EXPECT_GT(several, 10);
  EXPECT_GE(equal, looked * 9 / 10);
}

}  // namespace
}  // namespace ode_ext::audit
