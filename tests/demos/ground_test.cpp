// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/mesh_oracle.h"
#include "meshes/shapes.h"
#include "simulation/placement.h"

namespace falling_objects {
namespace {

TEST(Ground, IsAClosedSlabWoundOutwards) {
  const Ground ground(12, 1);
  EXPECT_TRUE(is_closed(ground.mesh()));
  EXPECT_GT(signed_volume(ground.mesh()), 0);
  EXPECT_GT(smallest_area(ground.mesh()), 0.05);  // half a cell of 0.375 m is 0.07
  // 64 x 64 cells; 256 border edges, each a quad of the wall and a triangle of the bottom.
  EXPECT_EQ(ground.mesh().triangle_count(), 2u * 64 * 64 + 3u * 256);
}

TEST(Ground, KnowsTheHeightOfItsOwnSurface) {
  const Ground ground(12, 1);
  const ode_ext::oracle::Mesh oracle(ground.mesh().vertices, ground.mesh().indices);
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const double x = random.between(-11.9, 11.9), y = random.between(-11.9, 11.9);
    // Vertices are rounded to float: 2^-21 at a height of 8 to 16 m.
    EXPECT_NEAR(oracle.signed_distance({x, y, ground.height(x, y)}), 0, 1e-6);
  }
}

TEST(Ground, IsABowlButAnIrregularOne) {
  const Ground ground(12, 1);
  EXPECT_GT(ground.height(11, 0), ground.height(0, 0) + 3);
  EXPECT_GT(ground.height(0, -11), ground.height(0, 0) + 3);
  // On a circle a regular bowl has one height.
  double low = INFINITY, high = -INFINITY;
  for (int i = 0; i < 100; ++i) {
    const double z = ground.height(6 * std::cos(0.0628 * i), 6 * std::sin(0.0628 * i));
    low = std::min(low, z);
    high = std::max(high, z);
  }
  EXPECT_GT(high - low, 0.3);
}

TEST(Ground, IsAnotherOneWithAnotherSeedAndTheSameWithTheSame) {
  EXPECT_EQ(Ground(12, 1).mesh().vertices, Ground(12, 1).mesh().vertices);
  EXPECT_NE(Ground(12, 1).mesh().vertices, Ground(12, 2).mesh().vertices);
}

class Placements : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Counts, Placements, testing::Values(1, 4, 7, 100, 1000, 3000));

TEST_P(Placements, KeepTheBoundingSpheresApartAndAboveTheGround) {
  const std::size_t count = GetParam();
  const Ground ground(ground_half_size(count), 3);
  Random random(3);
  const auto placements = place_objects(count, 4, ground, random);
  ASSERT_EQ(placements.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const Point& a = placements[i].position;
    EXPECT_LT(std::max(std::abs(a[0]), std::abs(a[1])), ground.half_size() - kShapeRadius);
    for (double angle = 0; angle < 6.28; angle += 0.5) {
      const double x = a[0] + 0.99 * kShapeRadius * std::cos(angle);
      const double y = a[1] + 0.99 * kShapeRadius * std::sin(angle);
      EXPECT_GT(a[2] - kShapeRadius, ground.height(x, y));
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Point& b = placements[j].position;
      ASSERT_GE(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 2 * kShapeRadius - 1e-12);
    }
  }
}

TEST_P(Placements, UseEveryShapeEquallyOften) {
  const std::size_t count = GetParam();
  const Ground ground(12, 3);
  Random random(3);
  std::array<std::size_t, 4> used{};
  for (const Placement& placement : place_objects(count, 4, ground, random)) {
    ++used[placement.shape];
    const auto& q = placement.rotation;
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-12);
  }
  const auto [least, most] = std::minmax_element(used.begin(), used.end());
  EXPECT_LE(*most - *least, 1u);
}

}  // namespace
}  // namespace falling_objects
