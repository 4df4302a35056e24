// SPDX-License-Identifier: BSD-3-Clause
// Thin bodies deep in open ground. It is solid behind its faces: what went through them is as deep
// as it is, however thin, and comes out by the front.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "contacts/lowered.h"
#include "contacts/placed.h"
#include "support/extruded.h"

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

// Open, about z, its front inwards: a spout, and a cone on it.
TestMesh make_funnel(int sides) {
  TestMesh mesh;
  for (const auto& [radius, height] : {std::pair{0.12, -0.9}, {0.15, -0.5}, {1.3, 0.6}})
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      for (const double x : {radius * std::cos(angle), radius * std::sin(angle), height})
        mesh.vertices.push_back(static_cast<float>(x));
    }
  const auto n = static_cast<unsigned>(sides);
  for (unsigned ring = 0; ring < 2 * n; ring += n)
    for (unsigned i = 0; i < n; ++i) {
      const unsigned a = ring + i, b = ring + (i + 1) % n;
      mesh.indices.insert(mesh.indices.end(), {a, a + n, b + n, a, b + n, b});
    }
  return mesh;
}

// An edge that is all but parallel to a facet may enter it before it leaves the one beside it, as
// far as rounding can tell. The stretch between is in front of both, so no plane is known for it;
// it was to leave by a facet of the spout, across the funnel: of a gear that rested there by 167 mm
// where it was 1 mm in it, and not at all 10 um beside that.
TEST(OpenGround, OfManyFacetsSendsNothingAcrossItself) {
  const TestMesh funnel = moved(make_funnel(24), {0, -6, 0});
  Profile outline;  // of a gear
  for (int tooth = 0; tooth < 12; ++tooth)
    for (const auto& [radius, part] :
         {std::pair{0.256, 0.0}, {0.32, 0.15}, {0.32, 0.4}, {0.256, 0.55}}) {
      const double angle = 2 * std::numbers::pi / 12 * (tooth + part);
      outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  const TestMesh gear = extruded(outline, 0.128);
  const double w = -0.648172457, x = -0.148560818, y = -0.075151461, z = -0.743070931;
  TestPose pose{{-0.085979925, -5.977977514, -0.259017630},
                {1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
                 2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                 2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
  Random random(36);
  for (int i = 0; i < 300; ++i) {
    const double right = random.uniform(-1e-5, 1e-5);
    const double ahead = random.uniform(-1e-5, 1e-5);
    pose.position = {-0.085979925 + right, -5.977977514 + ahead, -0.259017630};
    const Placed placed{gear, funnel, pose, TestPose{}};
    const std::vector<Contact> found = placed.contacts(TestPose{});
    ASSERT_GT(found.size(), 2u);
    EXPECT_LT(deepest(found), 0.003) << i;
  }
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

// The rays of the vertices round the end of a post are as long as the post is wide. That in the
// middle of the end, which bounds nothing and has no contact, has a ray as long as the post; it
// said how deep rays tell of all. So from where the post was in by its width it had contacts of no
// depth, or sideways.
TEST(OpenGround, HoldsPostsAsDeepAsTheyAreWhateverTheirEndsAreCutInto) {
  Random random(34);
  const TestMesh ground = make_sheet(4, 40);
  for (const TestMesh& post : {make_box({0.02, 0.02, 0.2}), make_box({0.02, 0.02, 0.2}, 2, 2, 1),
                               make_cylinder(0.01, 0.2, 6), make_cylinder(0.01, 0.2, 24)})
    for (const double depth : {0.005, 0.015, 0.019, 0.03, 0.06})
      for (int i = 0; i < 8; ++i) {
        const TestPose pose = sunk_by(depth, post, leaning(random, random.uniform(0, 0.3)));
        const Placed placed{post, ground, pose, TestPose{}};
        const TestPose frame = i % 2 == 0 ? TestPose{} : random.pose(2);
        const std::vector<Contact> found = placed.contacts(frame);
        EXPECT_NEAR(deepest(found), depth, 1e-3 * depth + placed.tolerance(frame))
            << post.triangle_count() << " triangles";
        for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.99);
      }
}

// A pyramid on a block of four sides that begins behind 0, along a direction.
TestMesh arm_of_caltrop(const Point& direction) {
  const Point along = unit(direction);
  const Point up = std::abs(along[2]) < 0.9 ? Point{0, 0, 1} : Point{1, 0, 0};
  const Point a = unit(cross(up, along)), b = cross(along, a);
  TestMesh arm;
  const auto add = [&](double x, double y, double z) {
    const Point p = x * a + y * b + z * along;
    for (const double v : p) arm.vertices.push_back(static_cast<float>(v));
  };
  add(0, 0, -0.02);
  add(0, 0, 0.15);
  for (const double z : {-0.02, 0.01})
    for (const auto& [x, y] : {std::pair(1, 0), {0, 1}, {-1, 0}, {0, -1}})
      add(0.046 * x, 0.046 * y, z);
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned j = (i + 1) % 4, low = 2, high = 6;
    arm.indices.insert(arm.indices.end(), {0, low + j, low + i, low + i, low + j, high + j, low + i,
                                           high + j, high + i, high + i, high + j, 1});
  }
  return arm;
}

// Where parts of a body overlap, it may be that the ray of a vertex is not known to leave: three
// arms or four of a caltrop were 0 mm deep on open ground.
TEST(OpenGround, HoldsCaltropsByTheirTips) {
  TestMesh caltrop = arm_of_caltrop({0, 0, -1});
  Random random(35);
  for (const Point& arm :
       {Point{0.943, 0, 0.333}, {-0.4714, 0.8165, 0.333}, {-0.4714, -0.8165, 0.333}}) {
    caltrop = merged(caltrop, arm_of_caltrop(arm));
    for (const double depth : {0.0005, 0.005, 0.02})
      for (int i = 0; i < 8; ++i) {
        const TestPose pose = sunk_by(depth, caltrop, leaning(random, i < 2 ? 0 : 0.05));
        const Placed placed{caltrop, make_sheet(4, 40), pose, TestPose{}};
        const std::vector<Contact> found = placed.contacts(TestPose{});
        EXPECT_NEAR(deepest(found), depth, 1e-3 * depth + placed.tolerance(TestPose{}))
            << caltrop.triangle_count() << " triangles";
        for (const Contact& c : found) EXPECT_GT(c.normal.z, 0.99);
      }
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

// The way out of a convex body along a direction, of what is in it.
double way_out(const TestMesh& body, const TestPose& pose, const TestMesh& inside,
               const Point& direction) {
  double to = -INFINITY, from = INFINITY;
  for (int i = 0; i < body.vertex_count(); ++i)
    to = std::max(to, dot(direction, to_world(pose, body.vertex(static_cast<std::size_t>(i)))));
  for (int i = 0; i < inside.vertex_count(); ++i)
    from = std::min(from, dot(direction, inside.vertex(static_cast<std::size_t>(i))));
  return to - from;
}

// A loose piece of the ground, all of it in a body that the rest is far below.
TEST(OpenGround, OfWhichAPieceIsInABodyIsTakenOutTheShortestWay) {
  Random random(36);
  const TestMesh islet = moved(make_sheet(0.2, 2), {0, 0, 1});
  const TestMesh ground = merged(make_sheet(4, 20), islet);
  const TestMesh ball = make_icosphere(0.6, 1);
  for (int i = 0; i < 40; ++i) {
    TestPose pose = random.pose(0.1);
    pose.position[2] += 1;
    double least = INFINITY;
    for (int k = 0; k < 5000; ++k)
      least = std::min(least, way_out(ball, pose, islet, random.direction()));
    const Placed placed{ball, ground, pose, TestPose{}};
    EXPECT_LT(deepest(placed.contacts(TestPose{})), 1.02 * least) << i;
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
