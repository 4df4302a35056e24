// SPDX-License-Identifier: BSD-3-Clause
#include "judging/crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "geometry/mesh_oracle.h"
#include "meshes/shapes.h"
#include "support/oracle_meshes.h"

namespace falling_objects {
namespace {

using ode_ext::oracle::Triangle;
using ode_ext::oracle::Vector;

const Triangle kFlat{Vector{0, 0, 0}, Vector{1, 0, 0}, Vector{0, 1, 0}};

TEST(TrianglesCross, WhereAnEdgeOfEitherGoesThroughTheOther) {
  const Triangle upright{Vector{0.2, 0.2, -0.5}, Vector{0.3, 0.2, 0.5}, Vector{2, 2, 0.5}};
  EXPECT_TRUE(triangles_cross(kFlat, upright));
  EXPECT_TRUE(triangles_cross(upright, kFlat));
  // Only the flat one's edges go through this one, which reaches beyond it on all sides.
  const Triangle wide{Vector{0.3, -9, -9}, Vector{0.3, 9, -9}, Vector{0.3, 0, 9}};
  EXPECT_TRUE(triangles_cross(kFlat, wide));
  EXPECT_TRUE(triangles_cross(wide, kFlat));
}

TEST(TrianglesCross, NeitherWhereTheyAreApartNorWhereTheyTouch) {
  const auto lifted = [](double z) {
    return Triangle{Vector{0.2, 0.2, z}, Vector{0.3, 0.2, z + 0.5}, Vector{0.2, 0.3, z + 0.5}};
  };
  EXPECT_FALSE(triangles_cross(kFlat, lifted(1e-9)));
  EXPECT_FALSE(triangles_cross(kFlat, lifted(0)));
  EXPECT_TRUE(triangles_cross(kFlat, lifted(-1e-9)));
  EXPECT_FALSE(triangles_cross(kFlat, kFlat));
  // Through the plane, but beside the triangle.
  EXPECT_FALSE(triangles_cross(kFlat, {Vector{1, 1, -1}, Vector{1, 1, 1}, Vector{2, 1, 0}}));
}

TEST(CrossingFinder, FindsWhatLookingAtEveryTriangleFinds) {
  const TriangleMesh jack = make_jack();
  const std::vector<Triangle> surface =
      ode_ext::oracle::Mesh(jack.vertices, jack.indices).triangles();
  const CrossingFinder finder(surface);
  std::mt19937_64 engine(1);
  const auto random = [&](double half) {
    const auto one = [&] { return half * (static_cast<double>(engine() >> 11) * 0x1p-52 - 1); };
    return Vector{one(), one(), one()};
  };
  int crossing = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector at = random(0.6);
    const Triangle triangle{at + random(0.03), at + random(0.03), at + random(0.03)};
    const bool expected = std::any_of(surface.begin(), surface.end(), [&](const Triangle& t) {
      return triangles_cross(triangle, t);
    });
    EXPECT_EQ(finder.crossed_by(triangle), expected);
    crossing += expected;
  }
  EXPECT_GT(crossing, 50);
  EXPECT_LT(crossing, 1950);
}

}  // namespace
}  // namespace falling_objects
