// SPDX-License-Identifier: BSD-3-Clause
// Bodies that are thinner than the distance within which contacts are merged.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "contacts/placed.h"
#include "contacts/upright.h"
#include "support/extruded.h"
#include "support/rig.h"

namespace ode_ext::test {
namespace {

// How many contacts hold each of four corners about the origin, by the signs of x and y.
std::array<int, 4> at_corners(const std::vector<Contact>& contacts) {
  std::array<int, 4> count{};
  for (const Contact& c : contacts)
    count[(c.position.x > 0 ? 1 : 0) + (c.position.y > 0 ? 2 : 0)] += 1;
  return count;
}

void expect_all_corners_once(const TestMesh& body, double height, const TestMesh& ground) {
  const Placed placed{body, ground, at(0, 0, 0.5 * height - 1e-4), at(0, 0, -0.5)};
  for (const TestPose& frame : some_frames())
    EXPECT_EQ(at_corners(placed.contacts(frame)), (std::array<int, 4>{1, 1, 1, 1}));
}

// With two contacts at corners across from one another one of 1 m and 1 cm fell over by itself
// after 3 to 7 s, and all rocked to and fro.
TEST(Thin, PanesStandOnAllFourCorners) {
  for (const double thickness : {0.02, 0.01, 0.004})
    expect_all_corners_once(make_box({1, thickness, 1}), 1, make_cube(4));
}

TEST(Thin, PostsStandOnAllFourCorners) {
  expect_all_corners_once(make_box({0.02, 0.02, 2}), 2, make_cube(4));
}

// A block of 1 m, and a rail of 1 cm below it.
TEST(Thin, RailsHoldWhatLiesOnThemAtAllFourCorners) {
  const Placed placed{make_cube(1), make_box({4, 0.01, 1}), at(0, 0, 0.5 - 1e-4), at(0, 0, -0.5)};
  for (const TestPose& frame : some_frames())
    EXPECT_EQ(at_corners(placed.contacts(frame)), (std::array<int, 4>{1, 1, 1, 1}));
}

// Of a part that is below the floor by more than it is thick the upper side proposed to leave by
// the lower side of the floor. So it was taken out vertex by vertex, the least deep first, and
// after sixteen of these the others had no contacts: 0.0055 m of 0.025.
TEST(Thin, PartsThatAreDeeperThanThickHaveContactsAsDeepAsTheyAre) {
  Profile teeth;
  for (int i = 0; i < 96; ++i) {
    const double angle = 2 * std::numbers::pi * i / 96, radius = (i & 2) != 0 ? 0.5 : 0.42;
    teeth.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  struct Part {
    const char* name;
    TestMesh mesh;
    double thickness;
  };
  Random random(1);
  for (const Part& part : {Part{"washer", hub(polygon(48, 0.25), 0.5, 0.01), 0.01},
                           {"thick washer", hub(polygon(48, 0.25), 0.5, 0.08), 0.08},
                           {"plate with a hole", hub(polygon(64, 0.3), 0.6, 0.02), 0.02},
                           {"gear", extruded(teeth, 0.04), 0.04}})
    for (const double deep : {1.0, 1.5, 2.0})
      for (int i = 0; i < 10; ++i) {
        const double around = random.uniform(0, 2 * std::numbers::pi);
        const TestPose leaning =
            turned({std::cos(around), std::sin(around), 0}, random.uniform(0.05, 0.2));
        TestPose pose = leaning;
        pose.position[2] = -lowest_of(part.mesh, leaning)[2] - deep * part.thickness;
        const Placed placed{part.mesh, make_box({20, 20, 2}), pose, at(0, 0, -1)};
        const std::vector<Contact> found = placed.contacts(TestPose{});
        EXPECT_NEAR(deepest(found), deep * part.thickness, 1e-4) << part.name << ", pose " << i;
        for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.99) << part.name << ", pose " << i;
      }
}

// Past the middle of a plate that is bent a little the lower side is nearer to what is deepest.
// That was sent out there, what is beside it back up, and the body was jammed and shot off.
TEST(Thin, BodiesMoreThanHalfwayThroughABentPlateGoBackByTheSideTheyCameIn) {
  const double thickness = 0.05;
  TestMesh plate = make_box({1.6, 1.6, thickness}, 2, 2, 1);
  for (std::size_t i = 0; i < plate.vertices.size(); i += 3)
    plate.vertices[i + 2] += 0.03f * std::abs(plate.vertices[i]);
  Random random(7);
  for (const TestMesh& body : {make_cylinder(0.15, 0.3, 24), make_icosphere(0.18, 2)})
    for (const double deep : {0.5, 0.7, 0.8, 0.9})
      for (int i = 0; i < 30; ++i) {
        TestPose pose = random.pose(0);
        const double x = random.uniform(-0.1, 0.1);
        double lowest = 1;  // over the upper side
        for (int k = 0; k < body.vertex_count(); ++k) {
          const Point p = rotate(pose, body.vertex(static_cast<std::size_t>(k)));
          lowest = std::min(lowest, p[2] - 0.03 * std::abs(x + p[0]));
        }
        const double in = deep * thickness;
        pose.position = {x, random.uniform(-0.3, 0.3), 0.5 * thickness - lowest - in};
        const std::vector<Contact> found =
            Placed{body, plate, pose, TestPose{}}.contacts(TestPose{});
        EXPECT_GT(deepest(found), 0.7 * in) << deep << ", pose " << i;
        for (const Contact& c : found) EXPECT_GT(c.normal.z, 0) << deep << ", pose " << i;
      }
}

// Of a body that is not convex each vertex was asked alone by which face it leaves, and that is the
// lower side of a board for what is past its middle, which nothing of the body has met. Up it is
// as far as the body is in the board. The wall of the pipe is thinner than half of that.
TEST(Thin, ConcaveBodiesMoreThanHalfwayThroughABoardGoBackByTheSideTheyCameIn) {
  const double thickness = 0.03;
  const TestMesh board = make_box({0.6, 0.6, thickness});
  const TestMesh pipe = hub(polygon(24, 0.077), 0.08, 0.16);
  Random random(11);
  for (const TestMesh& body :
       {make_l(0.2), make_torus(0.06, 0.02, 16, 8), make_torus(0.08, 0.02, 8, 6),
        hub(polygon(24, 0.03), 0.06, 0.03), make_comb(3, 0.03, 0.08, 0.05), pipe})
    for (const double deep : {0.55, 0.7, 0.9})
      for (int i = 0; i < 20; ++i) {
        const double around = random.uniform(0, 2 * std::numbers::pi);
        TestPose pose =
            composed(turned({std::cos(around), std::sin(around), 0}, random.uniform(0.04, 0.6)),
                     turned({1, 0, 0}, i % 2 == 0 ? 0 : 0.5 * std::numbers::pi));
        const double in = deep * thickness, lowest = lowest_of(body, pose)[2];
        pose.position = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1),
                         0.5 * thickness - lowest - in};
        const std::vector<Contact> found =
            Placed{body, board, pose, TestPose{}}.contacts(TestPose{});
        EXPECT_NEAR(deepest(found), in, 0.01 * in) << deep << ", pose " << i;
        for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.9) << deep << ", pose " << i;
      }
}

}  // namespace
}  // namespace ode_ext::test
