// SPDX-License-Identifier: BSD-3-Clause
// Bodies on ground that is made of boxes side by side, as of a world of voxels.
#include <gtest/gtest.h>

#include <cmath>

#include "contacts/placed.h"

namespace ode_ext::test {
namespace {

TestMesh ground_of_cubes(int layers) {
  TestMesh ground;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = 0; k < layers; ++k) {
        const Point middle{double(i), double(j), -0.5 - k};
        const TestMesh cube = moved(make_cube(1), middle);
        ground = ground.vertices.empty() ? cube : merged(ground, cube);
      }
  return ground;
}

// Of a die of the size of a cube, over one, between two or four, or anywhere, contacts had no
// depth and faced sideways: a wall of the next cube was the nearest plane. It fell through.
TEST(Abutting, CubesHoldADieAsOneBlockDoes) {
  const TestMesh block = moved(make_box({5, 5, 2}), {0, 0, -1});
  Random random(5);
  for (const int layers : {1, 2})
    for (const double size : {0.5, 1.0, 2.0})
      for (int i = 0; i < 24; ++i) {
        const double x = i < 9 ? 0.5 * (i % 3 - 1) : random.uniform(-1, 1);
        const double y = i < 9 ? 0.5 * (i / 3 - 1) : random.uniform(-1, 1);
        const TestPose pose = at(x, y, 0.5 * size - 0.002);
        const Placed on_cubes{make_cube(size), ground_of_cubes(layers), pose, TestPose{}};
        const Placed on_block{make_cube(size), block, pose, TestPose{}};
        const std::vector<Contact> found = on_cubes.contacts(TestPose{});
        const std::vector<Contact> expected = on_block.contacts(TestPose{});
        ASSERT_EQ(found.size(), expected.size()) << size << " at " << x << ", " << y;
        for (const Contact& c : found) {
          EXPECT_GT(c.normal.z, 0.999999);
          EXPECT_NEAR(c.depth, 0.002, 1e-5);
        }
      }
}

// The same shape cut into other boxes: two that touch along an edge alone are a solid too.
TEST(Abutting, WhatIsInsideACubeThatTouchesAnotherAlongAnEdgeIsFound) {
  const TestMesh two = merged(make_cube(1), moved(make_cube(1), {1, 1, 0}));
  for (const double x : {0.0, 1.0}) {
    const Placed inside{make_cube(0.1), two, at(x + 0.3, x, 0), TestPose{}};
    const std::vector<Contact> found = inside.contacts(TestPose{});
    ASSERT_FALSE(found.empty());
    EXPECT_NEAR(found[0].depth, 0.25, 1e-5);
    EXPECT_GT(found[0].normal.x, 0.999999);
  }
  const Placed between{make_cube(0.1), two, at(0.7, 0.2, 0), TestPose{}};
  EXPECT_TRUE(between.contacts(TestPose{}).empty());
}

}  // namespace
}  // namespace ode_ext::test
