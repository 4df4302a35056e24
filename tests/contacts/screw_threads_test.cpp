// SPDX-License-Identifier: BSD-3-Clause
// A nut on its bolt, both with a thread of sharp crests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contacts/placed.h"
#include "support/mesh_makers.h"

namespace ode_ext::test {
namespace {

constexpr double kPitch = 0.015, kRoot = 0.04, kCrest = 0.05;  // [m]
constexpr int kAround = 32;
constexpr double kTurn = 2 * std::numbers::pi;

Point on_circle(double radius, int i, double z) {
  const double angle = kTurn * (i % kAround) / kAround;
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// Points in columns about z, in each a crest and a root half a pitch apart, up by a pitch a turn.
// What is beyond an end lies on it.
struct Thread {
  double half;   // of its height [m]
  double wider;  // than the bolt's [m]

  int rows() const { return 2 * static_cast<int>(std::ceil(half / kPitch)) + 4; }
  Point at(int i, int row) const {
    if (i == kAround) return at(0, row + 2);
    const double up = static_cast<double>(i) / kAround;
    const double z = std::clamp(kPitch * (0.5 * row + up), -half, half);
    const double turns = z / kPitch - up;
    const double from_root = 2 * std::abs(turns - std::round(turns));
    return on_circle(kRoot + wider + (kCrest - kRoot) * from_root, i, z);
  }
  Point end(int i, double way) const { return at(i, way < 0 ? -rows() : rows()); }
};

// Adds a triangle with corners of its own, unless two of those are the same.
void add(TestMesh& mesh, const Point& a, const Point& b, const Point& c) {
  if (a == b || b == c || c == a) return;
  for (const Point& p : {a, b, c}) {
    mesh.indices.push_back(static_cast<unsigned>(mesh.vertices.size() / 3));
    for (const double v : p) mesh.vertices.push_back(static_cast<float>(v));
  }
}

void add_thread(TestMesh& mesh, const Thread& thread) {
  for (int i = 0; i < kAround; ++i)
    for (int row = -thread.rows(); row < thread.rows(); ++row) {
      const Point a = thread.at(i, row), c = thread.at(i + 1, row + 1);
      add(mesh, a, thread.at(i + 1, row), c);
      add(mesh, a, c, thread.at(i, row + 1));
    }
}

TestMesh make_bolt(double height) {
  const Thread thread{height / 2, 0};
  TestMesh mesh;
  add_thread(mesh, thread);
  for (int i = 0; i < kAround; ++i) {
    add(mesh, {0, 0, -thread.half}, thread.end(i + 1, -1), thread.end(i, -1));
    add(mesh, {0, 0, thread.half}, thread.end(i, 1), thread.end(i + 1, 1));
  }
  return mesh;
}

TestMesh make_nut(double height, double wider) {
  const Thread thread{height / 2, wider};
  const auto rim = [&](int i, double way) { return on_circle(0.08, i, way * thread.half); };
  TestMesh mesh;
  add_thread(mesh, thread);
  mesh = inverted(mesh);
  for (int i = 0; i < kAround; ++i) {
    add(mesh, rim(i, -1), rim(i + 1, -1), rim(i + 1, 1));
    add(mesh, rim(i, -1), rim(i + 1, 1), rim(i, 1));
    add(mesh, rim(i + 1, -1), rim(i, -1), thread.end(i, -1));
    add(mesh, rim(i + 1, -1), thread.end(i, -1), thread.end(i + 1, -1));
    add(mesh, rim(i, 1), rim(i + 1, 1), thread.end(i + 1, 1));
    add(mesh, rim(i, 1), thread.end(i + 1, 1), thread.end(i, 1));
  }
  return mesh;
}

// Along the axis a nut has play; past that its flanks are in by `in`, and facets of the two by what
// each cuts off a circle besides, at half a chord of either. Square to a flank `in` is 0.8 of that.
TEST(ScrewThreads, LetANutBackByLessThanTwiceWhatItTakesAlongTheAxis) {
  constexpr double kWider = 1e-3;
  const double steepness = 0.5 * kPitch / (kCrest - kRoot);  // of a flank along the axis
  const double cut_off = steepness * kCrest * (1 - std::cos(0.5 * kTurn / kAround));
  const TestMesh bolt = make_bolt(0.08), nut = make_nut(0.045, kWider);
  Random random(5);
  for (const double in : {1e-4, 3e-4, 1e-3})
    for (const double way : {-1.0, 1.0})
      for (int i = 0; i < 20; ++i) {
        const double angle = random.uniform(0, kTurn);
        const double z = kPitch * angle / kTurn + way * (kWider * steepness + in);
        const Placed placed{nut, bolt, turned({0, 0, 1}, angle, {0, 0, z}), TestPose{}};
        const double back = in + 2 * cut_off;
        Contact along{};
        along.normal = {0, 0, -way};
        ASSERT_FALSE(placed.intersect_after(along, back));
        const double depth = deepest(placed.contacts(TestPose{}));
        EXPECT_GT(depth, 0.7 * in) << in << " past the play, turned by " << angle;
        EXPECT_LT(depth, 2 * back) << in << " past the play, turned by " << angle;
      }
}

}  // namespace
}  // namespace ode_ext::test
