// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "geometry/triangle_box.h"

namespace ode_ext {
namespace {

// What is left of the triangle after clipping it by the six planes of the box.
bool overlaps_by_clipping(const std::array<Vec3d, 3>& triangle, Vec3d centre, Vec3d half_size) {
  std::vector<Vec3d> polygon(triangle.begin(), triangle.end());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      const auto beyond = [&](const Vec3d& p) {
        return side * (p[axis] - centre[axis]) - half_size[axis];
      };
      std::vector<Vec3d> clipped;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d& p = polygon[i];
        const Vec3d& q = polygon[(i + 1) % polygon.size()];
        const double a = beyond(p), b = beyond(q);
        if (a <= 0) clipped.push_back(p);
        if ((a < 0 && b > 0) || (a > 0 && b < 0)) clipped.push_back(p + (a / (a - b)) * (q - p));
      }
      polygon = clipped;
    }
  }
  return !polygon.empty();
}

double coordinate() { return *rc::gen::inRange(-4000, 4001) / 1000.0; }

Vec3d point() { return {coordinate(), coordinate(), coordinate()}; }

RC_GTEST_PROP(TriangleBox, AgreesWithClippingTheTriangle, ()) {
  const std::array<Vec3d, 3> triangle{point(), point(), point()};
  const Vec3d centre = 0.25 * point();
  // Sizes off the lattice of the corners: touching, where rounding would decide, does not occur.
  const Vec3d half_size{0.3003 + *rc::gen::inRange(0, 200) / 100.0,
                        0.4007 + *rc::gen::inRange(0, 200) / 100.0,
                        0.2009 + *rc::gen::inRange(0, 200) / 100.0};
  const bool expected = overlaps_by_clipping(triangle, centre, half_size);
  RC_CLASSIFY(expected, "overlap");
  RC_ASSERT(triangle_overlaps_box(triangle, centre, half_size) == expected);
}

TEST(TriangleBox, NeedsTheEdgeAxes) {
  // Past the corner (1, 1, 0) edge-on: no face normal of either separates them.
  const std::array<Vec3d, 3> triangle{{{3, -0.9, -2}, {-0.9, 3, -2}, {1.2, 1.2, 5}}};
  EXPECT_FALSE(triangle_overlaps_box(triangle, {0, 0, 0}, {1, 1, 0.01}));
  EXPECT_TRUE(triangle_overlaps_box(triangle, {0, 0, 0}, {1.2, 1.2, 0.01}));
}

TEST(TriangleBox, CountsTouchingAsOverlap) {
  const std::array<Vec3d, 3> triangle{{{1, 0, 0}, {2, 1, 0}, {2, -1, 0}}};
  EXPECT_TRUE(triangle_overlaps_box(triangle, {0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(triangle_overlaps_box(triangle, {-0.001, 0, 0}, {1, 1, 1}));
}

TEST(TriangleBox, TakesATriangleInsideTheBoxAndABoxInsideTheTriangle) {
  const std::array<Vec3d, 3> small{{{0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}}};
  const std::array<Vec3d, 3> large{{{-100, -100, 0.5}, {100, -100, 0.5}, {0, 100, 0.5}}};
  EXPECT_TRUE(triangle_overlaps_box(small, {0, 0, 0}, {1, 1, 1}));
  EXPECT_TRUE(triangle_overlaps_box(large, {0, 0, 0}, {1, 1, 1}));
  EXPECT_FALSE(triangle_overlaps_box(large, {0, 0, 0}, {1, 1, 0.4}));
}

}  // namespace
}  // namespace ode_ext
