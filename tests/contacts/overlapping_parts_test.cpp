// SPDX-License-Identifier: BSD-3-Clause
// Bodies that are one mesh of several boxes, of which one reaches into another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "contacts/placed.h"
#include "support/extruded.h"

namespace ode_ext::test {
namespace {

// A seat, four legs that go up into it and a back that stands in it and in two of them.
TestMesh chair() {
  TestMesh mesh =
      merged(make_box({0.4, 0.4, 0.05}), moved(make_box({0.05, 0.4, 0.5}), {-0.17, 0, 0.24}));
  for (const double x : {-0.17, 0.17})
    for (const double y : {-0.17, 0.17})
      mesh = merged(mesh, moved(make_box({0.05, 0.05, 0.42}), {x, y, -0.2}));
  return mesh;
}

// Lying on any side, a little turned, at the foot of a wall and a little in both. Where the foot
// goes through two parts, the face nearest to it may be one that a part has inside another. Then
// contacts were as deep as the chair is wide, in 14 of 600 poses, and some faced into the wall or
// the floor.
TEST(OverlappingParts, OfAChairAtTheFootOfAWallAreNotPushedIntoEither) {
  // The floor is y = 0, the wall x = 0.
  const TestMesh corner = extruded({{-2, -0.2}, {0.2, -0.2}, {0.2, 2}, {0, 2}, {0, 0}, {-2, 0}}, 4);
  const TestMesh body = chair();
  Random random(3);
  for (int i = 0; i < 600; ++i) {
    TestPose pose = turned(random.direction(), std::pow(10, random.uniform(-3.3, -1.5)));
    for (int quarter = 0; quarter < 4; ++quarter) {
      Point axis{0, 0, 0};
      axis[static_cast<std::size_t>(random.below(3))] = 1;
      pose = composed(pose, turned(axis, 0.5 * std::numbers::pi * random.below(4)));
    }
    double right = -std::numeric_limits<double>::infinity(), low = -right;
    for (std::size_t v = 0; v < body.vertices.size(); v += 3) {
      const Point p = to_world(pose, {double{body.vertices[v]}, double{body.vertices[v + 1]},
                                      double{body.vertices[v + 2]}});
      right = std::max(right, p[0]);
      low = std::min(low, p[1]);
    }
    const double most = std::pow(10, random.uniform(-3.5, -2));
    const double in_wall = random.uniform(0, most), in_floor = random.uniform(0, most);
    pose.position = {in_wall - right, -in_floor - low, 0};
    const Placed placed{body, corner, pose, TestPose{}};
    const double tolerance = placed.tolerance(TestPose{});
    const std::vector<Contact> found = placed.contacts(TestPose{});
    EXPECT_FALSE(found.empty()) << i;
    for (const Contact& c : found) {
      EXPECT_LT(c.depth, 1.5 * (in_wall + in_floor) + tolerance) << i;
      EXPECT_FALSE(c.depth > tolerance && (c.normal.x > 0.7 || c.normal.y < -0.7)) << i;
    }
  }
}

}  // namespace
}  // namespace ode_ext::test
