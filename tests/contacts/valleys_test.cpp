// SPDX-License-Identifier: BSD-3-Clause
// Tips of bodies in the valley between a floor and a wall.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contacts/placed.h"
#include "support/extruded.h"

namespace ode_ext::test {
namespace {

// Of the floor y = 0 and the wall x = 0, as an L is. One vertex of a tetrahedron is through both,
// none farther than 1 cm. The chord of the valley in its tip comes out past no face alone: in 10 of
// these poses it was sent out through the far side of the tetrahedron, by more than 10 cm.
TEST(Valleys, SendATipThatIsInBothTheirSidesNoFartherThanItIs) {
  const TestMesh valley = extruded({{-0.3, -0.3}, {1, -0.3}, {1, 0}, {0, 0}, {0, 1}, {-0.3, 1}}, 2);
  const TestMesh tip = make_tetrahedron(0.15);
  Random random(5);
  int poses = 0;
  while (poses < 1000) {
    TestPose pose = random.pose(0);
    const double in_floor = random.uniform(1e-3, 1e-2), in_wall = random.uniform(1e-3, 1e-2);
    const Point through = rotate(pose, tip.vertex(0));
    pose.position = {-in_wall - through[0], -in_floor - through[1], random.uniform(-0.5, 0.5)};
    double out_of_floor = 0, out_of_wall = 0;
    for (std::size_t v = 0; v < 4; ++v) {
      const Point p = rotate(pose, tip.vertex(v)) + pose.position;
      out_of_wall = std::max(out_of_wall, -p[0]);
      out_of_floor = std::max(out_of_floor, -p[1]);
    }
    if (std::max(out_of_floor, out_of_wall) > 1e-2) continue;
    ++poses;
    const std::vector<Contact> found = Placed{tip, valley, pose, TestPose{}}.contacts(TestPose{});
    EXPECT_GE(deepest(found), std::min(in_floor, in_wall) - 1e-5) << "pose " << poses;
    EXPECT_LE(deepest(found), std::hypot(out_of_floor, out_of_wall) + 1e-5) << "pose " << poses;
  }
}

}  // namespace
}  // namespace ode_ext::test
