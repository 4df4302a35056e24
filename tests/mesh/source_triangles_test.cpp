// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/source_triangles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "mesh/weld.h"
#include "shapes.h"

namespace ode_ext {
namespace {

bool have_same_bits(const Vec3f& a, const Vec3f& b) { return std::memcmp(&a, &b, sizeof(a)) == 0; }

// The same corners, with each place kept once, and one that is of none; the last places first.
SourceTriangles with_places_once(const TriangleSoup& soup) {
  SourceTriangles source;
  source.places.push_back({std::numeric_limits<float>::quiet_NaN(), 9, 9});
  for (auto corner = soup.rbegin(); corner != soup.rend(); ++corner) {
    const auto known = std::find_if(source.places.begin(), source.places.end(),
                                    [&](const Vec3f& at) { return have_same_bits(at, *corner); });
    source.corners.push_back(static_cast<std::uint32_t>(known - source.places.begin()));
    if (known == source.places.end()) source.places.push_back(*corner);
  }
  std::reverse(source.corners.begin(), source.corners.end());
  return source;
}

TEST(SourceTriangles, AreToldByTheirCornersHoweverTheirPlacesAreKept) {
  const TriangleSoup sphere = shapes::sphere(1, 24);
  ASSERT_GT(sphere.size(), 2000u);
  for (const std::size_t triangles :
       {std::size_t{1}, std::size_t{42}, std::size_t{43}, std::size_t{128}, sphere.size() / 3}) {
    TriangleSoup soup = sphere;
    soup.resize(3 * triangles);
    const SourceTriangles once = with_places_once(soup);
    EXPECT_EQ(hash_soup(once), hash_soup(soup.data(), soup.size()));
    EXPECT_EQ(hash_soup(SourceTriangles(soup)), hash_soup(once));
    EXPECT_EQ(compare_soups(once, soup), 0);
    EXPECT_TRUE(is_finite(once));
    EXPECT_EQ(box_of(once).lo, box_of(soup).lo);
    EXPECT_EQ(box_of(once).hi, box_of(soup).hi);
    EXPECT_EQ(weld(once).vertices, weld(soup).vertices);
    EXPECT_EQ(weld(once).triangles, weld(soup).triangles);
    EXPECT_EQ(weld(once, VertexOrder::kListing).vertices,
              weld(soup, VertexOrder::kListing).vertices);
  }
}

TEST(SourceTriangles, AreOrderedByTheBitsOfTheirCorners) {
  const TriangleSoup soup = shapes::cube();
  const SourceTriangles once = with_places_once(soup);
  for (std::size_t corner = 0; corner < soup.size(); ++corner) {
    TriangleSoup other = soup;
    other[corner].y += 0.5f;
    const int order = compare_soups(soup, other);
    EXPECT_NE(order, 0);
    EXPECT_EQ(compare_soups(once, other) < 0, order < 0);
    EXPECT_EQ(compare_soups(other, once) < 0, order > 0);
  }
  TriangleSoup signs = soup;
  std::find_if(signs.begin(), signs.end(), [](const Vec3f& v) { return v.x == 0; })->x = -0.0f;
  EXPECT_NE(compare_soups(signs, once), 0);
  TriangleSoup fewer = soup;
  fewer.resize(soup.size() - 3);
  EXPECT_LT(compare_soups(fewer, once), 0);
  EXPECT_GT(compare_soups(once, fewer), 0);
}

TEST(SourceTriangles, AreNotFiniteWhereACornerIsNot) {
  SourceTriangles once = with_places_once(shapes::cube());
  once.corners[7] = 0;
  EXPECT_FALSE(is_finite(once));
  EXPECT_EQ(compare_soups(once, once), 0);
  EXPECT_TRUE(is_finite(SourceTriangles()));
}

}  // namespace
}  // namespace ode_ext
