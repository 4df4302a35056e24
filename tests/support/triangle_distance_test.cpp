// SPDX-License-Identifier: BSD-3-Clause
#include "support/triangle_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace ode_ext {
namespace {

class TriangleDistance : public testing::Test {
 protected:
  Vec3d random_point() { return {place_(random_), place_(random_), place_(random_)}; }
  Segment random_segment() { return {random_point(), random_point()}; }
  Corners random_triangle() { return {random_point(), random_point(), random_point()}; }

  std::mt19937 random_{7};
  std::uniform_real_distribution<double> place_{-1, 1};
};

Vec3d at(const Segment& s, double part) { return s[0] + part * (s[1] - s[0]); }

// A convex function on [0, 1], by cutting off the worse third until nothing is left.
template <class Function>
double least(const Function& function) {
  double low = 0, high = 1;
  while (high - low > 1e-9) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (function(a) < function(b) ? high : low) = function(a) < function(b) ? b : a;
  }
  return function((low + high) / 2);
}

// A third of a billionth off the place costs the square of it, or that times the slope: 1e-8.
constexpr double kSearched = 1e-8;

double searched(Vec3d p, const Segment& s) {
  return least([&](double part) { return length(at(s, part) - p); });
}

double searched(Vec3d p, const Corners& t) {
  return least([&](double part) {
    return searched(p, Segment{at({t[0], t[1]}, part), at({t[0], t[2]}, part)});
  });
}

double searched(const Segment& a, const Segment& b) {
  return least([&](double part) { return searched(at(a, part), b); });
}

TEST_F(TriangleDistance, OfAPointAndASegmentIsTheLeast) {
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p = random_point();
    const Segment s = random_segment();
    EXPECT_NEAR(std::sqrt(squared_distance(p, s)), searched(p, s), kSearched);
  }
  EXPECT_EQ(squared_distance(Vec3d{3, 4, 0}, Segment{}), 25);
}

TEST_F(TriangleDistance, OfAPointAndATriangleIsTheLeast) {
  for (int i = 0; i < 2000; ++i) {
    const Vec3d p = random_point();
    const Corners t = random_triangle();
    EXPECT_NEAR(std::sqrt(squared_distance(p, t)), searched(p, t), kSearched);
  }
}

TEST_F(TriangleDistance, OfAPointAndATriangleWithoutAreaIsThatOfItsLongestSide) {
  for (int i = 0; i < 1000; ++i) {
    const Vec3d p = random_point();
    const Segment s = random_segment();
    const Corners t{s[0], at(s, 0.37), s[1]};
    EXPECT_NEAR(squared_distance(p, t), squared_distance(p, s), 1e-14);
  }
  EXPECT_EQ(squared_distance(Vec3d{3, 4, 0}, Corners{}), 25);
}

TEST_F(TriangleDistance, OfTwoSegmentsIsTheLeast) {
  for (int i = 0; i < 2000; ++i) {
    const Segment a = random_segment(), b = random_segment();
    EXPECT_NEAR(std::sqrt(squared_distance(a, b)), searched(a, b), kSearched);
  }
}

TEST_F(TriangleDistance, OfParallelSegmentsIsThatOfTheirEndsOrLines) {
  for (const double tilt : {0.0, 1e-12, 1e-7, 1e-5}) {
    const Segment a{Vec3d{0, 0, 0}, Vec3d{1, 0, 0}};
    EXPECT_NEAR(squared_distance(a, Segment{Vec3d{0.5, 2, 0}, Vec3d{3, 2 + tilt, 0}}), 4, 1e-4);
    EXPECT_NEAR(squared_distance(a, Segment{Vec3d{4, 4, 0}, Vec3d{8, 4 + tilt, 0}}), 25, 1e-4);
    EXPECT_NEAR(squared_distance(a, Segment{Vec3d{-1, 0, 0}, Vec3d{2, tilt, 0}}), 0, 1e-9);
  }
}

TEST_F(TriangleDistance, SaysThatASegmentCrossesWhereItsEndsAreOnBothSidesWithinTheRim) {
  int crossing = 0;
  for (int i = 0; i < 20000; ++i) {
    const Corners t = random_triangle();
    // Barycentric coordinates of the place, and the ends' heights over the plane.
    const double u = 1.5 * place_(random_), v = 1.5 * place_(random_);
    const double start = place_(random_), end = place_(random_);
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
