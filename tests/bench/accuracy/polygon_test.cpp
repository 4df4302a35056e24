// SPDX-License-Identifier: BSD-3-Clause
#include "bench/accuracy/polygon.h"

#include <gtest/gtest.h>

#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <cmath>
#include <numbers>

#include "support/mesh_makers.h"

namespace ode_ext::accuracy {
namespace {

using boost::geometry::area;

bool has_corner(const Polygon& polygon, const Point2& corner) {
  for (const Point2& p : polygon) {
    if (std::hypot(p.x() - corner.x(), p.y() - corner.y()) < 1e-9) return true;
  }
  return false;
}

TEST(Polygon, OfAlignedSquaresIsARectangle) {
  const Polygon common = intersection(square(2, {0, 0}, 0), square(2, {1, 0.5}, 0));
  ASSERT_EQ(common.size(), 4u);
  for (const Point2 corner : {Point2{0, -0.5}, Point2{1, -0.5}, Point2{1, 1}, Point2{0, 1}})
    EXPECT_TRUE(has_corner(common, corner)) << corner.x() << ", " << corner.y();
}

TEST(Polygon, OfASquareOnItselfTurnedByHalfARightAngleIsAnOctagon) {
  const Polygon common =
      intersection(square(1, {3, 4}, 0), square(1, {3, 4}, std::numbers::pi / 4));
  EXPECT_EQ(common.size(), 8u);
  EXPECT_NEAR(area(common), 2 * std::tan(std::numbers::pi / 8), 1e-12);  // of incircle radius 1/2
}

TEST(Polygon, OfASquareOnItselfIsTheSquare) {
  EXPECT_EQ(intersection(square(1, {0, 0}, 0.3), square(1, {0, 0}, 0.3)).size(), 4u);
}

TEST(Polygon, OfSquaresApartIsEmpty) {
  EXPECT_TRUE(intersection(square(1, {0, 0}, 0), square(1, {1.3, 0}, 0.4)).empty());
}

TEST(Polygon, HoldsThePointsThatAreInBoth) {
  test::Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Polygon a = square(1, {0, 0}, random.uniform(0, 6));
    const Polygon b =
        square(1, {random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)}, random.uniform(0, 6));
    const Polygon common = intersection(a, b);
    const int samples = 20000;
    int in_both = 0;
    const auto inside = [](const Polygon& p, double x, double y) {
      for (std::size_t i = 0; i < 4; ++i) {
        const Point2 &from = p[i], &to = p[(i + 1) % 4];
        if ((to.x() - from.x()) * (y - from.y()) < (to.y() - from.y()) * (x - from.x()))
          return false;
      }
      return true;
    };
    for (int i = 0; i < samples; ++i) {
      const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
      in_both += inside(a, x, y) && inside(b, x, y);
    }
    // Four standard deviations of a share of 4 m2 that is at most a quarter.
    EXPECT_NEAR(area(common), 4.0 * in_both / samples, 4 * 4 * std::sqrt(0.25 * 0.75 / samples));
  }
}

TEST(LeastSideways, IsTheShorterOverlapOfAlignedSquares) {
  EXPECT_NEAR(least_sideways(square(2, {0, 0}, 0), square(2, {1.5, 0.3}, 0)), 0.5, 1e-12);
  EXPECT_NEAR(least_sideways(square(2, {0, 0}, 0), square(2, {2.5, 0.3}, 0)), -0.5, 1e-12);
}

TEST(LeastSideways, SeesACornerPokeIntoASide) {
  const double half_diagonal = std::sqrt(0.5);
  EXPECT_NEAR(least_sideways(square(1, {0, 0}, 0),
                             square(1, {0.5 + half_diagonal - 0.1, 0}, std::numbers::pi / 4)),
              0.1, 1e-12);
}

}  // namespace
}  // namespace ode_ext::accuracy
