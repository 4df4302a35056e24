// SPDX-License-Identifier: BSD-3-Clause
// Bodies that hang over the border of an open mesh: a ledge, a platform, a hole in a floor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "contacts/placed.h"

namespace ode_ext::test {
namespace {

// [m] 2 % of the radius of the sheet: of contacts that are nearer one is kept.
constexpr double kMerge = 0.02 * 1.4143;

// Seen from above.
bool is_near(const Contact& a, const Contact& b, double distance) {
  return std::hypot(a.position.x - b.position.x, a.position.y - b.position.y) < distance;
}

bool has_corner_over(const TestPose& pose, const Point& size) {
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5}) {
      const Point p = to_world(pose, {x * size[0], y * size[1], 0});
      if (std::abs(p[0]) < 1 && std::abs(p[1]) < 1) return true;
    }
  return false;
}

// Only corners that are over it had contacts: a box with a tenth of it over the border tipped off.
// (One that has none over it lies on the border alone, and on all of its vertices.)
TEST(Border, HoldsABodyAsTheEdgeOfASolidDoes) {
  const TestMesh solid = moved(make_box({2, 2, 1}), {0, 0, -0.5});
  Random random(6);
  std::size_t over = 0;
  for (const int cells : {1, 3, 20}) {
    const TestMesh sheet = make_sheet(2, cells);
    for (const Point& size : {Point{1, 1, 1}, {0.4, 0.4, 1.8}, {1.5, 0.3, 0.2}, {3, 0.5, 0.5}})
      for (int i = 0; i < 20; ++i) {
        const TestPose pose =
            turned({0, 0, 1}, random.uniform(0, 3),
                   {random.uniform(0.4, 1), random.uniform(-1, 1), 0.5 * size[2] - 0.001});
        if (!has_corner_over(pose, size)) continue;
        const Placed on_sheet{make_box(size), sheet, pose, TestPose{}};
        const Placed on_solid{make_box(size), solid, pose, TestPose{}};
        const std::vector<Contact> found = on_sheet.contacts(TestPose{});
        for (const Contact& c : found) {
          EXPECT_GT(c.normal.z, 0.999999);
          EXPECT_NEAR(c.depth, 0.001, 1e-5);
          over += std::abs(c.position.x - 1) < 1e-6 ? 1 : 0;
        }
        for (const Contact& c : on_solid.contacts(TestPose{}))
          EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                                  [&](const Contact& other) { return is_near(c, other, kMerge); }))
              << cells << " cells, " << i << " of " << found.size() << ", size " << size[0]
              << ": none at " << c.position.x << ", " << c.position.y;
      }
  }
  EXPECT_GT(over, 200u);
}

}  // namespace
}  // namespace ode_ext::test
