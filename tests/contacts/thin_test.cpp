// SPDX-License-Identifier: BSD-3-Clause
// Bodies that are thinner than the distance within which contacts are merged.
#include <gtest/gtest.h>

#include <array>

#include "contacts/placed.h"
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

}  // namespace
}  // namespace ode_ext::test
