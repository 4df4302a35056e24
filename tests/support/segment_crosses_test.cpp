// SPDX-License-Identifier: BSD-3-Clause
#include "support/segment_crosses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ode_ext {
namespace {

TEST(SegmentCrosses, WhereItsEndsAreOnBothSidesAndThePlaceIsWithinTheRim) {
  std::mt19937 random{7};
  std::uniform_real_distribution<double> number{-1, 1};
  const auto random_point = [&] { return Vec3d{number(random), number(random), number(random)}; };
  int crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    const Corners t{random_point(), random_point(), random_point()};
    // Barycentric coordinates of the place, and the ends' heights over the plane.
    const double u = 1.5 * number(random), v = 1.5 * number(random);
    const double start = number(random), end = number(random);
    if (std::min({std::fabs(u), std::fabs(v), std::fabs(1 - u - v)}) < 1e-6) continue;
    const Vec3d n = cross(t[1] - t[0], t[2] - t[0]);
    if (length(n) < 1e-3) continue;
    const Vec3d place = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
    const Vec3d slant = random_point() - place;
    const Vec3d along = n + 0.1 * (slant - (dot(slant, n) / dot(n, n)) * n);
    const bool expected = start * end < 0 && u > 0 && v > 0 && u + v < 1;
    EXPECT_EQ(crosses({place + start * along, place + end * along}, t), expected);
    crossing += expected;
  }
  EXPECT_GT(crossing, 200);
}

}  // namespace
}  // namespace ode_ext
