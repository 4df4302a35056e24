// SPDX-License-Identifier: BSD-3-Clause
// Tips of bodies in the valley between a floor and a wall.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "contacts/placed.h"
#include "support/extruded.h"

namespace ode_ext::test {
namespace {

// How far the vertices of a mesh reach along a direction.
double reach(const TestMesh& mesh, const TestPose& pose, const Point& direction) {
  double most = -1e9;
  for (int v = 0; v < mesh.vertex_count(); ++v)
    most = std::max(most, dot(direction, rotate(pose, mesh.vertex(static_cast<std::size_t>(v))) +
                                             pose.position));
  return most;
}

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
    const double out_of_wall = reach(tip, pose, {-1, 0, 0});
    const double out_of_floor = reach(tip, pose, {0, -1, 0});
    if (std::max(out_of_floor, out_of_wall) > 1e-2) continue;
    ++poses;
    const std::vector<Contact> found = Placed{tip, valley, pose, TestPose{}}.contacts(TestPose{});
    EXPECT_GE(deepest(found), std::min(in_floor, in_wall) - 1e-5) << "pose " << poses;
    EXPECT_LE(deepest(found), std::hypot(out_of_floor, out_of_wall) + 1e-5) << "pose " << poses;
  }
}

// Along z, with its foot at 0: two flanks that open by so many degrees.
struct Groove {
  explicit Groove(double opening)
      : half(0.5 * opening * std::numbers::pi / 180),
        flanks{Point{std::cos(half), std::sin(half), 0}, {-std::cos(half), std::sin(half), 0}} {
    const double x = 0.5 * std::sin(half), y = 0.5 * std::cos(half);
    mesh = extruded(
        {{-x - 0.2, -0.4}, {x + 0.2, -0.4}, {x + 0.2, y}, {x, y}, {0, 0}, {-x, y}, {-x - 0.2, y}},
        2);
  }
  // How deep a body is in a flank.
  double depth(std::size_t flank, const TestMesh& body, const TestPose& pose) const {
    return reach(body, pose, -1 * flanks[flank]);
  }
  // Where a point is so deep in both.
  Point place(double in_first, double in_second) const {
    return {0.5 * (in_second - in_first) / std::cos(half),
            -0.5 * (in_first + in_second) / std::sin(half), 0};
  }

  double half;                  // [radians]
  std::array<Point, 2> flanks;  // their normals
  TestMesh mesh;
};

// A tip is in both flanks by up to half a millimetre, and another vertex lies at one of them. The
// chord of the groove's foot comes out past no face of the body alone, and came before what is in
// the flanks: 9 of these 1,000 poses had a contact of more than 2 mm, of 12 cm.
TEST(Valleys, SendNoBodyThatLiesInAGrooveFartherThanItIs) {
  const Groove groove(60);
  const TestMesh body = make_tetrahedron(0.15);
  TestMesh others = body;  // but the tip
  others.vertices.erase(others.vertices.begin(), others.vertices.begin() + 3);
  Random random(7);
  int poses = 0;
  while (poses < 1000) {
    TestPose pose = random.pose(0);
    const double in_first = random.uniform(1e-5, 5e-4), in_second = random.uniform(1e-5, 5e-4);
    const double along = random.uniform(-0.3, 0.3);
    pose.position =
        groove.place(in_first, in_second) - rotate(pose, body.vertex(0)) + Point{0, 0, along};
    const double nearest = std::max(groove.depth(0, others, pose), groove.depth(1, others, pose));
    if (std::abs(nearest) > 3e-4) continue;
    ++poses;
    const Placed placed{body, groove.mesh, pose, TestPose{}};
    const double depth = deepest(placed.contacts(TestPose{}));
    EXPECT_LT(depth, 2e-3) << "pose " << poses;
    EXPECT_GE(depth, std::min(in_first, in_second) - 1e-5) << "pose " << poses;
  }
}

// A body that is in both flanks by 1 to 5 mm, mostly by one vertex, has contacts that push it out
// of either: a chord that ended in the vertex took it out of one flank, and was out of the other
// itself. Of these 400 bodies 26 had no contact for one of them, and 3 have none still.
TEST(Valleys, HoldATipByBothFlanksOfAGroove) {
  const TestMesh body = make_tetrahedron(0.15);
  Random random(8);
  int missing = 0;
  for (const double opening : {60.0, 80.0, 90.0, 100.0}) {
    const Groove groove(opening);
    for (int i = 0; i < 100;) {
      TestPose pose = random.pose(0);
      const std::array<double, 2> lowest{groove.depth(0, body, pose), groove.depth(1, body, pose)};
      const std::array<double, 2> in{random.uniform(1e-3, 5e-3), random.uniform(1e-3, 5e-3)};
      pose.position = groove.place(in[0] - lowest[0], in[1] - lowest[1]);
      if (std::abs(pose.position[0]) > 0.1) continue;
      ++i;
      const Placed placed{body, groove.mesh, pose, TestPose{}};
      const std::vector<Contact> found = placed.contacts(TestPose{});
      for (const std::size_t flank : {0u, 1u}) {
        double most = 0;
        for (const Contact& c : found)
          most = std::max(most, c.depth * dot(groove.flanks[flank], point_of(c.normal)));
        missing += most < 0.25 * in[flank] ? 1 : 0;
      }
    }
  }
  EXPECT_LE(missing, 3);
}

}  // namespace
}  // namespace ode_ext::test
