// SPDX-License-Identifier: BSD-3-Clause
// Bodies that hang over the border of an open mesh: a ledge, a platform, a hole in a floor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
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

// Its own side is past the border by little, its bottom is far below: it was pushed up by half of
// its size, or not at all.
TEST(Border, HoldsBackWhatReachesOverItFromTheSide) {
  Random random(7);
  const TestMesh cube = make_cube(1);
  for (const int cells : {1, 8, 40})
    for (const double by : {0.001, 0.01, 0.05})
      for (const double below : {0.3, 0.499, 0.501, 0.9}) {
        const TestPose pose = at(2.5 - by, random.uniform(-1, 1), 0.5 - below);
        const Placed placed{cube, make_sheet(4, cells), pose, TestPose{}};
        const TestPose frame = random.pose(2);
        const std::vector<Contact> found = placed.contacts(frame);
        ASSERT_FALSE(found.empty());
        EXPECT_NEAR(deepest(found), by, placed.tolerance(frame)) << cells << ", " << below;
        for (const Contact& c : found) EXPECT_GT(c.normal.x, 0.999999);
      }
}

// Its lowest edge is beyond the border. Tilted by more than 26 degrees it had contacts of no depth.
TEST(Border, HoldsATiltedBodyAsTheEdgeOfASolidDoes) {
  Random random(8);
  const TestMesh solid = moved(make_box({4, 4, 3}), {0, 0, -1.5});
  const double half = 0.5;
  for (const int cells : {1, 20})
    for (const double degrees : {5.0, 20.0, 25.0, 27.0, 30.0, 45.0, 60.0}) {
      const double angle = degrees * std::numbers::pi / 180;
      const TestPose pose = turned(
          {0, 1, 0}, angle,
          {2 + half * std::sin(angle), random.uniform(-1, 1), half * std::cos(angle) - 0.01});
      const TestPose frame = random.pose(2);
      const Placed on_sheet{make_cube(1), make_sheet(4, cells), pose, TestPose{}};
      const Placed on_solid{make_cube(1), solid, pose, TestPose{}};
      const std::vector<Contact> found = on_sheet.contacts(frame);
      ASSERT_FALSE(found.empty());
      EXPECT_NEAR(deepest(found), 0.01 * std::cos(angle), on_sheet.tolerance(frame)) << degrees;
      EXPECT_NEAR(deepest(found), deepest(on_solid.contacts(frame)), on_solid.tolerance(frame));
      for (const Contact& c : found) {
        EXPECT_NEAR(c.normal.x, std::sin(angle), 1e-5) << degrees;
        EXPECT_NEAR(c.normal.z, std::cos(angle), 1e-5) << degrees;
      }
    }
}

// Rods and planks that lean over it from above: their lower end is beyond it, and all of them is
// below it there, so that nothing of it is in them. They had contacts of no depth, and fell through
// between the tiles of a floor.
TEST(Border, HoldsWhatPassesBelowItAsTheEdgeOfASolidDoes) {
  Random random(11);
  const TestMesh solid = moved(make_box({4, 4, 3}), {0, 0, -1.5});
  const TestMesh rods[] = {make_cylinder(0.024, 1.2, 8), make_cylinder(0.024, 1.2, 5),
                           make_box({0.05, 0.05, 1.2}), make_box({0.05, 0.05, 1.2}, 1, 1, 7),
                           make_box({0.012, 0.5, 1.2})};
  for (const TestMesh& rod : rods)
    for (const int cells : {1, 20})
      for (const double degrees : {5.0, 10.0, 20.0, 40.0}) {
        // So deep where it passes the border, all of it below.
        const double angle = degrees * std::numbers::pi / 180;
        const double below = 0.06 / std::cos(angle);
        const double beyond = random.uniform(0.02, 0.3);
        const double yaw = random.uniform(-0.2, 0.2);
        const double across = random.uniform(-1, 1);
        const TestPose lean = turned({0, 1, 0}, std::numbers::pi / 2 + angle);
        TestPose pose = composed(turned({0, 0, 1}, yaw), lean);
        const Point axis = rotate(pose, {0, 0, 1});
        const double along = beyond / axis[0];
        pose.position = Point{2, across, -below} + (along - 0.6) * axis;
        const TestPose frame = random.pose(2);
        const Placed on_sheet{rod, make_sheet(4, cells), pose, TestPose{}};
        const Placed on_solid{rod, solid, pose, TestPose{}};
        const std::vector<Contact> found = on_sheet.contacts(frame);
        ASSERT_FALSE(found.empty());
        const Contact rim = on_solid.contacts(frame).front();  // the deepest
        const double truth = rim.depth;
        EXPECT_GT(truth, 0.06);
        EXPECT_GT(deepest(found), truth - on_sheet.tolerance(frame)) << degrees << ", " << cells;
        // Straight up, past the face of a cell, it is farther.
        const double most = cells == 1 ? truth : truth / rim.normal.z;
        EXPECT_LT(deepest(found), most + on_sheet.tolerance(frame)) << degrees << ", " << cells;
        for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.75);
      }
}

// From x = 0 on it falls to one side.
TestMesh tile(double side, double slope, int cells) {
  TestMesh sheet = moved(make_sheet(4, cells), {2 * side, 0, 0});
  for (std::size_t i = 0; i < sheet.vertices.size(); i += 3)
    sheet.vertices[i + 2] = -static_cast<float>(slope) * std::abs(sheet.vertices[i]);
  return sheet;
}

// What of a body is lowest is beside the border of both: 13 of 200 bodies had contacts of no depth
// on slopes of a twentieth, 147 on slopes of one.
TEST(Border, OfTilesThatMeetAtACrestHoldsABodyAsOneMeshDoes) {
  Random random(9);
  const TestMesh bodies[] = {make_cube(0.6), make_box({1.2, 0.4, 0.1}), make_tetrahedron(0.8),
                             make_cylinder(0.3, 0.2, 24), make_icosphere(0.4, 2)};
  int crossed = 0;
  for (const double slope : {0.05, 0.2, 1.0})
    for (const int cells : {4, 12})
      for (int i = 0; i < 25; ++i) {
        const TestMesh& body = bodies[i % 5];
        const TestMesh tiles[] = {tile(-1, slope, cells), tile(1, slope, cells)};
        TestPose pose = random.pose(0);
        pose.position = {random.uniform(-0.1, 0.1), random.uniform(-1, 1), 0};
        const auto touches = [&](double height) {
          TestPose raised = pose;
          raised.position[2] = height;
          return surfaces_intersect(body, raised, tiles[0], TestPose{}) ||
                 surfaces_intersect(body, raised, tiles[1], TestPose{});
        };
        double in = 0, out = 1;
        while (out - in > 2e-4) (touches(0.5 * (in + out)) ? in : out) = 0.5 * (in + out);
        const double by = random.uniform(0.002, 0.02);
        pose.position[2] = in - by;
        for (const TestMesh& mesh : tiles) {
          const Placed placed{body, mesh, pose, TestPose{}};
          if (!surfaces_intersect(body, pose, mesh, TestPose{})) continue;
          ++crossed;
          const std::vector<Contact> found = placed.contacts(TestPose{});
          ASSERT_FALSE(found.empty());
          // Moves are past planes, not straight up, so a little more may come over the border.
          EXPECT_LT(deepest(found), 1.05 * (by + out - in));
          EXPECT_FALSE(placed.intersect_after(
              *std::max_element(
                  found.begin(), found.end(),
                  [](const Contact& a, const Contact& b) { return a.depth < b.depth; }),
              1.05 * deepest(found) + placed.tolerance(TestPose{})))
              << slope << ", " << cells << " cells, body " << i;
        }
      }
  EXPECT_GT(crossed, 150);
}

// Every vertex is of the border, and begins up to four of its edges.
TEST(Border, OfAChequeredFloorBearsABallByAllItsCells) {
  Random random(11);
  const int cells = 40;
  TestMesh floor = make_sheet(2, cells);
  std::vector<unsigned> kept;
  for (std::size_t t = 0; t < floor.indices.size(); t += 3) {
    Point middle{};
    for (std::size_t k = 0; k < 3; ++k)
      middle = middle + (1.0 / 3) * floor.vertex(floor.indices[t + k]);
    const int column = static_cast<int>((middle[0] + 1) * cells / 2);
    const int row = static_cast<int>((middle[1] + 1) * cells / 2);
    if ((column + row) % 2 == 0)
      kept.insert(kept.end(), floor.indices.begin() + static_cast<std::ptrdiff_t>(t),
                  floor.indices.begin() + static_cast<std::ptrdiff_t>(t) + 3);
  }
  floor.indices = kept;
  for (int i = 0; i < 20; ++i) {
    const double by = random.uniform(0.01, 0.1);
    const TestPose pose =
        turned({1, 2, 3}, i, {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0.4 - by});
    const Placed placed{make_icosphere(0.4, 4), floor, pose, TestPose{}};
    const std::vector<Contact> found = placed.contacts(TestPose{});
    ASSERT_FALSE(found.empty());
    EXPECT_LE(deepest(found), 1.05 * by);
    EXPECT_GT(deepest(found), 0.5 * by);
    for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.7);
  }
}

// A fence longer than what lies on it: that was sent along its own length, or held by nothing.
TEST(Border, OfAWallBearsWhatLiesOnItsTop) {
  Random random(10);
  const TestMesh plank = make_box({2, 0.4, 0.08});
  for (const double length : {0.2, 1.0, 4.0})
    for (const double by : {0.001, 0.01, 0.03})
      for (int i = 0; i < 8; ++i) {
        // Facing +x, its top at z = 0.
        const TestPose wall =
            composed(at(0, 0, -length / 2), turned({0, 1, 0}, std::numbers::pi / 2));
        const TestPose pose =
            turned({0, 0, 1}, random.uniform(-0.3, 0.3), {random.uniform(-0.5, 0.5), 0, 0.04 - by});
        const Placed placed{plank, make_sheet(length, 1 + 4 * (i % 2)), pose, wall};
        const TestPose frame = random.pose(2);
        const std::vector<Contact> found = placed.contacts(frame);
        ASSERT_FALSE(found.empty());
        EXPECT_NEAR(deepest(found), by, placed.tolerance(frame)) << length;
        for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.999999);
      }
}

}  // namespace
}  // namespace ode_ext::test
