// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/facets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "shapes.h"
#include "support/test_scene.h"

namespace ode_ext {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// The triangles of each facet, each by its corners, whatever their order.
using Place = std::array<std::array<float, 3>, 3>;

Place place_of(const Mesh& mesh, std::size_t triangle) {
  Place place;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3f p = mesh.vertices[mesh.topology->triangles[triangle][k]];
    place[k] = {p.x, p.y, p.z};
  }
  std::sort(place.begin(), place.end());
  return place;
}

// By their largest triangles.
std::map<std::uint32_t, std::set<Place>> facets_of(const Mesh& mesh) {
  std::map<std::uint32_t, std::set<Place>> facets;
  EXPECT_EQ(mesh.topology->facets.size(), mesh.topology->triangles.size());
  for (std::size_t t = 0; t < mesh.topology->facets.size(); ++t)
    facets[mesh.topology->facets[t]].insert(place_of(mesh, t));
  for (const auto& [largest, facet] : facets)
    EXPECT_TRUE(facet.contains(place_of(mesh, largest))) << "a triangle that is none of it";
  return facets;
}

std::multiset<std::size_t> sizes_of(const TriangleSoup& soup) {
  std::multiset<std::size_t> sizes;
  for (const auto& [largest, facet] : facets_of(build_mesh(soup))) sizes.insert(facet.size());
  return sizes;
}

// Strips of width 1 along y, each bent against the last by `angle` [rad].
TriangleSoup arc(int strips, double angle) {
  std::vector<Vec3d> points{{0, 0, 0}};
  for (int i = 0; i < strips; ++i)
    points.push_back(points.back() + Vec3d{std::cos(i * angle), 0, std::sin(i * angle)});
  TriangleSoup soup;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3f a(points[i]), b(points[i + 1]), across{0, 1, 0};
    shapes::append(soup, a, b, b + across);
    shapes::append(soup, a, b + across, a + across);
  }
  return soup;
}

// The triangles in another order, each from another corner on.
TriangleSoup shuffled(const TriangleSoup& soup, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::size_t> order(soup.size() / 3);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  TriangleSoup result;
  for (const std::size_t t : order) {
    const std::size_t first = random() % 3;
    for (std::size_t k = 0; k < 3; ++k) result.push_back(soup[3 * t + (first + k) % 3]);
  }
  return result;
}

TEST(Facets, OfACubeAreItsSixSidesHoweverFinelyItIsCut) {
  for (const int steps : {1, 2, 5}) {
    for (const unsigned diagonals : {0u, 21u, 63u}) {
      const auto each = static_cast<std::size_t>(2 * steps * steps);
      EXPECT_EQ(sizes_of(shapes::box({0, 0, 0}, {1, 2, 3}, steps, diagonals)),
                (std::multiset<std::size_t>{each, each, each, each, each, each}));
    }
  }
}

TEST(Facets, OfARoundMeshAreItsTriangles) {
  for (const int subdivisions : {0, 2, 4}) {
    const TriangleSoup soup = test::soup_of(test::make_icosphere(1, subdivisions));
    EXPECT_EQ(facets_of(build_mesh(soup)).size(), soup.size() / 3);
  }
}

TEST(Facets, EndAtABendOfATenthOfADegree) {
  for (const double sign : {1.0, -1.0}) {
    EXPECT_EQ(sizes_of(arc(2, sign * 0.099 * kDegree)), (std::multiset<std::size_t>{4}));
    EXPECT_EQ(sizes_of(arc(2, sign * 0.101 * kDegree)), (std::multiset<std::size_t>{2, 2}));
  }
}

// Each strip is flat against the next, all together they turn by 3 degrees.
TEST(Facets, DoNotFollowAGentleCurve) {
  const Mesh mesh = build_mesh(arc(100, 0.03 * kDegree));
  // Three strips to either side of one differ from it by less than 0.1 degrees.
  EXPECT_GE(facets_of(mesh).size(), 100u / 7);
  EXPECT_LT(facets_of(mesh).size(), 100u);
  // Of one of its triangles all differ by less than a tenth of a degree, so of one another by less
  // than two.
  for (std::uint32_t t = 0; t < mesh.topology->facets.size(); ++t)
    for (std::uint32_t other = 0; other < t; ++other) {
      if (mesh.topology->facets[t] != mesh.topology->facets[other]) continue;
      const Vec3d away = face_normal(mesh, t) - face_normal(mesh, other);
      EXPECT_LT(length(away), 0.2 * kDegree);
    }
}

TEST(Facets, DoNotDependOnTheOrderOfTheTriangles) {
  const TriangleSoup soups[] = {arc(60, 0.03 * kDegree), shapes::box({0, 0, 0}, {1, 1, 1}, 4, 37),
                                shapes::sphere(1, 12),
                                test::soup_of(test::jittered(test::make_cube(1, 6), 2e-4, 3))};
  for (const TriangleSoup& soup : soups) {
    const auto expected = facets_of(build_mesh(soup));
    for (std::uint32_t seed = 0; seed < 5; ++seed)
      EXPECT_EQ(facets_of(build_mesh(shuffled(soup, seed))), expected);
  }
}

// Its plane stands for all of them.
TEST(Facets, AreNamedByTheirLargestTriangle) {
  const TriangleSoup soup{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0},    {3, 3, 0},
                          {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {-0.5f, 0, 0}};
  const Mesh mesh = build_mesh(soup);
  for (const std::uint32_t facet : mesh.topology->facets)
    EXPECT_EQ(mesh.topology->source_triangle[facet], 1u);
}

TEST(Facets, AreConnected) {
  // Two cubes side by side have sides in one plane, and two at an edge share that edge alone.
  const TriangleSoup apart = shapes::joined(shapes::cube(), shapes::box({2, 0, 0}, {3, 1, 1}));
  EXPECT_EQ(facets_of(build_mesh(apart)).size(), 12u);
  const TriangleSoup at_edge = shapes::joined(shapes::cube(), shapes::box({1, 1, 0}, {2, 2, 1}));
  EXPECT_EQ(facets_of(build_mesh(at_edge)).size(), 12u);
}

TEST(Facets, EndWhereMoreThanTwoTrianglesMeet) {
  TriangleSoup soup;
  const Vec3f a{0, 0, 0}, b{0, 1, 0};
  shapes::append(soup, a, {1, 0, 0}, b);
  shapes::append(soup, b, {-1, 0, 0}, a);
  EXPECT_EQ(sizes_of(soup), (std::multiset<std::size_t>{2}));
  shapes::append(soup, a, b, {0, 0, 1});  // a fin
  EXPECT_EQ(sizes_of(soup), (std::multiset<std::size_t>{1, 1, 1}));
}

// A border that is cut on one side only, mended with a triangle of no area.
TEST(Facets, OfTrianglesOfNoAreaAreTheirOwn) {
  const Vec3f a{0, 0, 0}, b{2, 0, 0}, middle{1, 0, 0};
  TriangleSoup soup;
  shapes::append(soup, a, b, {1, 1, 0});
  shapes::append(soup, b, a, middle);
  shapes::append(soup, a, {1, -1, 0}, middle);
  shapes::append(soup, middle, {1, -1, 0}, b);
  const Mesh mesh = build_mesh(soup);
  ASSERT_EQ(mesh.topology->triangles.size(), 4u);
  EXPECT_EQ(sizes_of(soup), (std::multiset<std::size_t>{1, 1, 2}));
  EXPECT_EQ(std::count(mesh.topology->facets.begin(), mesh.topology->facets.end(),
                       mesh.topology->facets[1]),
            1);
}

TEST(Facets, OfNothingAreNone) { EXPECT_TRUE(facets({}, {}, {}, {}).empty()); }

// A disc with a needle at each of its chords: rounding turns these by degrees.
TEST(Facets, AreNotBrokenByNeedlesThatRoundingTurns) {
  const int sides = 48;
  const Vec3f middle{};
  const auto at = [&](double radius, double side) {
    const double angle = 2 * std::numbers::pi * side / sides;
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    // Turned out of the planes of coordinates, which round nothing.
    return Vec3f(Vec3d{x, 0.8 * y, 0.6 * y});
  };
  for (const double thin : {1e-4, 1e-5, 1e-6}) {
    const double inner = 0.5 * (1 - thin) * std::cos(std::numbers::pi / sides);
    TriangleSoup soup;
    for (int i = 0; i < sides; ++i) {
      const Vec3f a = at(0.5, i), b = at(0.5, i + 1), in = at(inner, i + 0.5);
      shapes::append(soup, middle, a, in);
      shapes::append(soup, middle, in, b);
      shapes::append(soup, a, b, in);
    }
    EXPECT_EQ(sizes_of(soup), (std::multiset<std::size_t>{3u * sides})) << thin;
  }
}

// A plate as thin as rounding has two sides all the same, and a rim.
TEST(Facets, FaceOneWay) {
  EXPECT_EQ(sizes_of(shapes::box({0, 0, 0}, {2e-7f, 1, 1})),
            (std::multiset<std::size_t>{2, 2, 2, 2, 2, 2}));
}

}  // namespace
}  // namespace ode_ext
