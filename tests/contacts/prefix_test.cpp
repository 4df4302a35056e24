// SPDX-License-Identifier: BSD-3-Clause
// The first contacts of a pair, for programs that ask for few.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "contacts/placed.h"

namespace ode_ext::test {
namespace {

// A cube whose lower face ends in a bevel a few millimetres high, that goes up and down from vertex
// to vertex, as where a surface was made of samples.
TestMesh bevelled_cube(double size, int n) {
  TestMesh mesh = make_cube(size, n);
  const double half = 0.5 * size;
  const auto is_at = [&](float x) { return std::abs(std::abs(x) - half) < 1e-6; };
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
    float* p = &mesh.vertices[i];
    if (p[2] > -half + 1e-6 || !(is_at(p[0]) || is_at(p[1]))) continue;
    const long step = std::lround((p[0] + p[1]) / size * n);
    p[2] += step % 2 == 0 ? 0.003f : 0.0015f;
  }
  return mesh;
}

// Whether a point is in the polygon of some others: they lie all round it.
bool is_amidst(const std::vector<Contact>& contacts, std::size_t count, const Point& middle) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < std::min(count, contacts.size()); ++i)
    angles.push_back(
        std::atan2(contacts[i].position.y - middle[1], contacts[i].position.x - middle[0]));
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2 * std::numbers::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i)
    widest = std::max(widest, angles[i] - angles[i - 1]);
  return widest < std::numbers::pi;
}

// Its units are cleared one after the other past the floor, by a plane that is chosen several
// times. Each of these counted as a manifold of its own, of which the deepest come first, all at
// the lower side.
TEST(FirstFour, ContactsOfABevelledFaceThatLeansALittleHoldItAllRound) {
  Random random(12);
  const TestMesh floor = moved(make_box({3, 3, 1}), {0, 0, -0.5});
  int poses = 0;
  for (const int n : {8, 16, 32}) {
    const TestMesh cube = bevelled_cube(0.4, n);
    for (const double lean : {1e-4, 1e-3}) {
      for (int i = 0; i < 20; ++i) {
        const double azimuth = random.uniform(-3, 3);
        TestPose pose = turned({std::cos(azimuth), std::sin(azimuth), 0}, lean);
        double lowest = 0;
        for (std::size_t v = 0; v < cube.vertices.size(); v += 3)
          lowest = std::min(lowest, to_world(pose, cube.vertex(v / 3))[2]);
        pose.position = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), -lowest - lean};
        const Placed placed{cube, floor, pose, TestPose{}};
        const std::vector<Contact> found = placed.contacts(TestPose{});
        ASSERT_GE(found.size(), 4u);
        EXPECT_TRUE(is_amidst(found, 4, pose.position)) << n << ", " << lean << ", " << i;
        ++poses;
      }
    }
  }
  EXPECT_EQ(poses, 120);
}

}  // namespace
}  // namespace ode_ext::test
