// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/feature_number.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "shapes.h"

namespace ode_ext {
namespace {

// Of the program's triangles those that have all of some places among their corners.
std::vector<std::uint32_t> triangles_with(const TriangleSoup& soup,
                                          const std::vector<Vec3f>& places) {
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; 3 * t < soup.size(); ++t) {
    const auto has = [&](const Vec3f& place) {
      return std::count(soup.begin() + 3 * t, soup.begin() + 3 * t + 3, place) > 0;
    };
    if (std::all_of(places.begin(), places.end(), has)) triangles.push_back(t);
  }
  return triangles;
}

TEST(FeatureNumbers, GiveTheTrianglesAtAVertex) {
  const TriangleSoup soup = shapes::box({0, 0, 0}, {1, 2, 3}, 2);
  const Mesh mesh = build_mesh(soup);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    EXPECT_EQ(triangles_at(*mesh.topology, to_feature(FeatureKind::kVertex, v)),
              triangles_with(soup, {mesh.vertices[v]}));
}

TEST(FeatureNumbers, GiveTheTrianglesAtAnEdge) {
  const TriangleSoup soup = shapes::box({0, 0, 0}, {1, 2, 3}, 2);
  const Mesh mesh = build_mesh(soup);
  for (std::uint32_t e = 0; e < mesh.topology->edges.size(); ++e) {
    const auto& ends = mesh.topology->edges[e].vertices;
    const auto found = triangles_at(*mesh.topology, to_feature(FeatureKind::kEdge, e));
    EXPECT_EQ(found, triangles_with(soup, {mesh.vertices[ends[0]], mesh.vertices[ends[1]]}));
    EXPECT_EQ(found.size(), 2u);
  }
}

TEST(FeatureNumbers, GiveTheSameTrianglesHoweverOftenTheyRepeat) {
  const Mesh mesh = build_mesh(shapes::cube());
  for (const FeatureKind kind : {FeatureKind::kVertex, FeatureKind::kEdge}) {
    const std::uint32_t feature = to_feature(kind, 3);
    for (const std::uint64_t times : {1u, 7u}) {
      const std::uint32_t again = repeated(*mesh.topology, feature, times);
      EXPECT_NE(again, feature);
      EXPECT_EQ(triangles_at(*mesh.topology, again), triangles_at(*mesh.topology, feature));
    }
  }
}

TEST(FeatureNumbers, GiveNoTrianglesOfAFacet) {
  const Mesh mesh = build_mesh(shapes::cube());
  EXPECT_TRUE(triangles_at(*mesh.topology, to_feature(FeatureKind::kFacet, 0)).empty());
  EXPECT_TRUE(triangles_at(*mesh.topology, 0).empty());
}

}  // namespace
}  // namespace ode_ext
