// SPDX-License-Identifier: BSD-3-Clause
// Thin bodies deep in open ground. It is solid behind its faces: what went through them is as deep
// as it is, however thin, and comes out by the front.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "contacts/placed.h"

namespace ode_ext::test {
namespace {

// Turned about a random level axis by so much, and then about z.
TestPose leaning(Random& random, double angle) {
  const double way = random.uniform(0, 2 * std::numbers::pi);
  const TestPose level = turned({0, 0, 1}, random.uniform(0, 2 * std::numbers::pi));
  return composed(turned({std::cos(way), std::sin(way), 0}, angle), level);
}

// Lowered until its lowest point is so far below z = 0.
TestPose sunk_by(double depth, const TestMesh& body, TestPose pose) {
  double lowest = 0;
  for (std::size_t i = 0; i < body.vertices.size() / 3; ++i)
    lowest = std::min(lowest, to_world(pose, body.vertex(i))[2]);
  pose.position = pose.position + Point{0, 0, -depth - lowest};
  return pose;
}

// In by more than they are thick they had contacts 0 mm deep, and fell through.
TEST(OpenGround, HoldsPlanksThatWentInByTheirEndsAsDeepAsTheyAre) {
  Random random(31);
  for (const int cells : {2, 40})
    for (const TestMesh& plank : {make_box({2, 0.2, 0.04}), make_box({2, 0.2, 0.04}, 20, 4, 1)})
      for (const double depth : {0.02, 0.04, 0.08, 0.16, 0.32})
        for (int i = 0; i < 12; ++i) {
          const double angle = std::asin(random.uniform(std::min(0.99, 0.6 * depth + 0.2), 1));
          const TestPose pose =
              sunk_by(depth, plank, composed(leaning(random, 0), turned({0, 1, 0}, angle)));
          const Placed placed{plank, make_sheet(4, cells), pose, TestPose{}};
          const TestPose frame = i % 2 == 0 ? TestPose{} : random.pose(2);
          const std::vector<Contact> found = placed.contacts(frame);
          ASSERT_FALSE(found.empty());
          EXPECT_NEAR(deepest(found), depth, 1e-3 * depth + placed.tolerance(frame))
              << cells << " cells, " << angle << " radians";
          for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.99);
        }
}

// The shortest way to where nothing crosses is down.
TEST(OpenGround, PushesAPlateUpOfWhichACornerAloneSticksOut) {
  Random random(32);
  const TestMesh plate = make_box({0.6, 0.3, 0.075});
  for (int i = 0; i < 60; ++i) {
    const TestPose pose = sunk_by(0.075, plate, leaning(random, random.uniform(0.01, 0.26)));
    const Placed placed{plate, make_sheet(1.6, 16), pose, TestPose{}};
    const std::vector<Contact> found = placed.contacts(TestPose{});
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(deepest(found), 0.075, 1e-4);
    for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.99);
  }
}

// Peaks of the ground that are past the middle of the plate are nearer to its top. What the moves
// before take the plate up by costs nothing any more, so that they do not push it down again: they
// did in 20 of 50.
TEST(OpenGround, HardlyPushesAPlateDownThatLiesInSoftHills) {
  TestMesh hills = make_sheet(1.6, 16);
  Random random(33);
  int pushed_down = 0;
  for (int i = 0; i < 50; ++i) {
    const double phase = random.uniform(0, 6);
    for (std::size_t k = 0; k < hills.vertices.size(); k += 3)
      hills.vertices[k + 2] = static_cast<float>(0.005 * std::sin(7 * hills.vertices[k] + phase) *
                                                 std::cos(5 * hills.vertices[k + 1]));
    const TestMesh plate = make_box({0.6, 0.3, 0.075});
    const TestPose pose = sunk_by(0.06, plate, leaning(random, random.uniform(0, 0.26)));
    const Placed placed{plate, hills, pose, TestPose{}};
    const std::vector<Contact> found = placed.contacts(TestPose{});
    ASSERT_FALSE(found.empty());
    EXPECT_GT(found.front().normal.z, 0.9);
    pushed_down +=
        std::any_of(found.begin(), found.end(), [](const Contact& c) { return c.normal.z < -0.5; });
  }
  EXPECT_LE(pushed_down, 5);
}

}  // namespace
}  // namespace ode_ext::test
