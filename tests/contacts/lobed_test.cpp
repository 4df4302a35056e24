// SPDX-License-Identifier: BSD-3-Clause
// Bodies whose surface bends in and out, so that parts of them lie between parts of others.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contacts/lowered.h"
#include "contacts/placed.h"

namespace ode_ext::test {
namespace {

// A ball about 0 of so many rows of triangles, of which the surface goes in and out by 1 cm: 17
// times around and 4 times from pole to pole, so that it is a crown at each.
TestMesh make_lobed(int rows) {
  const int around = 2 * rows;
  TestMesh mesh;
  const auto add = [&](double turn, double down) {
    const double polar = down * std::numbers::pi, angle = turn * 2 * std::numbers::pi;
    const double radius = 0.2 + 0.01 * std::sin(17 * angle) * std::sin(8 * polar);
    for (const double x : {radius * std::sin(polar) * std::cos(angle),
                           radius * std::sin(polar) * std::sin(angle), radius * std::cos(polar)})
      mesh.vertices.push_back(static_cast<float>(x));
  };
  add(0, 0);
  for (int row = 1; row < rows; ++row)
    for (int i = 0; i < around; ++i) add(double(i) / around, double(row) / rows);
  add(0, 1);
  const auto at = [&](int row, int i) {
    return static_cast<unsigned>(row == 0 ? 0 : 1 + (row - 1) * around + i % around);
  };
  const unsigned last = static_cast<unsigned>(mesh.vertex_count()) - 1;
  for (int i = 0; i < around; ++i) {
    mesh.indices.insert(mesh.indices.end(), {0, at(1, i), at(1, i + 1)});
    for (int row = 1; row + 1 < rows; ++row)
      mesh.indices.insert(mesh.indices.end(), {at(row, i), at(row + 1, i), at(row + 1, i + 1),
                                               at(row, i), at(row + 1, i + 1), at(row, i + 1)});
    mesh.indices.insert(mesh.indices.end(), {at(rows - 1, i), last, at(rows - 1, i + 1)});
  }
  return mesh;
}

// Where the edge of one lobe cuts that of another there is no plane of either past which nothing of
// what overlaps is, but far away; all of the ball was sent there, of which other lobes were in the
// way. So it is out straight up, by as much as it was lowered.
TEST(Lobed, BallsThatInterlockAreNotSentOutPastAllOfOneAnother) {
  Random random(29);
  int contacts = 0;
  for (const int rows : {24, 48}) {
    const TestMesh ball = make_lobed(rows);
    const FclSurface surface(ball);
    for (const double by : {0.003, 0.01}) {
      for (int i = 0; i < 60; ++i) {
        TestPose pose = turned({0, 0, 1}, random.uniform(0, 1));
        pose.position = {random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), 0};
        pose = lowered_onto(surface, ball, pose, 0.5, 0.2, by);
        for (const Contact& c : Placed{ball, ball, pose, TestPose{}}.contacts(TestPose{})) {
          EXPECT_LT(c.depth, 2 * by) << rows << " rows, " << by << ", " << i;
          ++contacts;
        }
      }
    }
  }
  EXPECT_GT(contacts, 1000);
}

}  // namespace
}  // namespace ode_ext::test
