// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "mesh/mesh.h"
#include "mesh/ray_cast.h"
#include "shapes.h"
#include "support/extruded.h"
#include "support/test_scene.h"

namespace ode_ext {
namespace {

using Ends = std::array<std::uint32_t, 2>;

bool runs(const Triangle& triangle, std::uint32_t from, std::uint32_t to) {
  for (std::size_t k = 0; k < 3; ++k)
    if (triangle[k] == from && triangle[(k + 1) % 3] == to) return true;
  return false;
}

bool is_in_order(const Mesh& mesh, std::uint32_t first, std::uint32_t second) {
  const Vec3f &a = mesh.vertices[first], &b = mesh.vertices[second];
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

// The triangles at every edge, the slow way. Ends are in the order of their places.
std::map<Ends, std::vector<std::uint32_t>> all_edges(const Mesh& mesh) {
  const std::vector<Triangle>& triangles = mesh.topology->triangles;
  std::map<Ends, std::vector<std::uint32_t>> result;
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      result[is_in_order(mesh, a, b) ? Ends{a, b} : Ends{b, a}].push_back(t);
    }
  return result;
}

std::vector<TriangleSoup> manifolds() {
  return {shapes::tetrahedron(),         shapes::cube(),   shapes::box({0, 0, 0}, {1, 1, 1}, 4, 22),
          shapes::sphere(1, 8),          shapes::sheet(5), shapes::torus(1, 0.3, 12),
          shapes::turned(shapes::cube())};
}

TEST(Edges, OfACubeAreTheTwelveBetweenItsSidesHoweverFinelyItIsCut) {
  for (const int steps : {1, 2, 5}) {
    const Mesh mesh = build_mesh(shapes::box({0, 0, 0}, {1, 1, 1}, steps, 25));
    EXPECT_EQ(mesh.topology->edges.size(), static_cast<std::size_t>(12 * steps));
    for (const Edge& edge : mesh.topology->edges) {
      const Vec3f a = mesh.vertices[edge.vertices[0]], b = mesh.vertices[edge.vertices[1]];
      int on_sides = 0;  // an edge of the cube lies on two of its sides
      for (std::size_t axis = 0; axis < 3; ++axis)
        on_sides += a[axis] == b[axis] && (a[axis] == 0 || a[axis] == 1);
      EXPECT_EQ(on_sides, 2);
    }
  }
}

TEST(Edges, OfARoundMeshAreAllOfThem) {
  for (const int subdivisions : {0, 1, 3}) {
    const TriangleSoup soup = test::soup_of(test::make_icosphere(1, subdivisions));
    EXPECT_EQ(build_mesh(soup).topology->edges.size(), soup.size() / 2);
  }
}

TEST(Edges, AreThoseWhoseTrianglesAreOfDifferentFacets) {
  for (const TriangleSoup& soup : manifolds()) {
    const Mesh mesh = build_mesh(soup);
    std::map<Ends, const Edge*> found;
    for (const Edge& edge : mesh.topology->edges)
      EXPECT_TRUE(found.emplace(edge.vertices, &edge).second);
    std::size_t expected = 0;
    for (const auto& [ends, at] : all_edges(mesh)) {
      ASSERT_LE(at.size(), 2u);
      const bool cast =
          at.size() == 1 || mesh.topology->facets[at[0]] != mesh.topology->facets[at[1]];
      EXPECT_EQ(found.contains(ends), cast);
      expected += cast;
      if (!cast || !found.contains(ends)) continue;
      const Edge& edge = *found.at(ends);
      if (at.size() == 1) {
        EXPECT_EQ(edge.triangles, (Ends{at[0], kNone}));
      } else {  // that which runs the edge upwards first
        EXPECT_TRUE(runs(mesh.topology->triangles[edge.triangles[0]], ends[0], ends[1]));
        EXPECT_TRUE(runs(mesh.topology->triangles[edge.triangles[1]], ends[1], ends[0]));
      }
    }
    EXPECT_EQ(mesh.topology->edges.size(), expected);
  }
}

// By their places, so that it does not matter how a program numbers them.
TEST(Edges, NameTheirVerticesInAscendingOrder) {
  for (const TriangleSoup& soup : manifolds()) {
    const Mesh mesh = build_mesh(soup);
    for (const Edge& edge : mesh.topology->edges)
      EXPECT_TRUE(is_in_order(mesh, edge.vertices[0], edge.vertices[1]));
  }
}

TEST(Edges, AreBetweenFacetsOrWithinOne) {
  for (const TriangleSoup& soup : manifolds()) {
    const Mesh mesh = build_mesh(soup);
    for (const Edge& edge : mesh.topology->flat_edges)
      EXPECT_EQ(mesh.topology->facets[edge.triangles[0]], mesh.topology->facets[edge.triangles[1]]);
    for (const Edge& edge : mesh.topology->edges)
      EXPECT_TRUE(edge.triangles[1] == kNone || mesh.topology->facets[edge.triangles[0]] !=
                                                    mesh.topology->facets[edge.triangles[1]]);
  }
}

// A side of n x n squares has (n - 1)^2 vertices that no edge between sides joins to anything; the
// edges between the sides join all others.
TEST(Edges, WithinFacetsAreAsFewAsJoinAllVertices) {
  for (const int n : {1, 2, 5}) {
    const Mesh mesh = build_mesh(test::soup_of(test::make_cube(1, n)));
    EXPECT_EQ(mesh.topology->edges.size(), static_cast<std::size_t>(12 * n));
    EXPECT_EQ(mesh.topology->flat_edges.size(), static_cast<std::size_t>(6 * (n - 1) * (n - 1)));
  }
}

// Of a facet with a hole one leads from its rim to that of the hole.
TEST(Edges, WithinAFacetJoinTheRimOfAHoleToThatAboutIt) {
  for (const int corners : {3, 4, 9}) {
    const test::TestMesh plate = test::hub(test::polygon(corners, 1), 2, 0.5);
    const Mesh mesh = build_mesh(test::soup_of(plate));
    ASSERT_EQ(mesh.topology->flat_edges.size(), 2u);
    for (const Edge& edge : mesh.topology->flat_edges) {
      const auto radius = [&](std::size_t end) {
        const Vec3f v = mesh.vertices[edge.vertices[end]];
        return std::hypot(v.x, v.y);
      };
      EXPECT_NEAR(std::abs(radius(0) - radius(1)), 1, 1e-6);
    }
  }
}

TEST(Edges, AreAllOfThemWithoutFacets) {
  for (const TriangleSoup& soup : manifolds()) {
    const Mesh rigid = build_mesh(soup);
    const Edges edges = find_edges(rigid.vertices, half_edges_of(rigid.topology->triangles), {});
    EXPECT_EQ(edges.apart.size(), all_edges(rigid).size());
    EXPECT_TRUE(edges.flat.empty());
    const Mesh deformable = build_mesh(soup, {.deformable = true});
    EXPECT_TRUE(deformable.topology->facets.empty());
    EXPECT_EQ(deformable.topology->edges.size(), all_edges(deformable).size());
  }
}

TEST(Edges, OfASheetAreItsBorder) {
  const Mesh mesh = build_mesh(shapes::sheet(6));
  EXPECT_EQ(mesh.topology->edges.size(), 24u);
  for (const Edge& edge : mesh.topology->edges) EXPECT_EQ(edge.triangles[1], kNone);
}

// Each of the triangles that meet there is at one of the edges.
TEST(Edges, AreSeveralWhereMoreThanTwoTrianglesMeet) {
  for (std::size_t fins = 3; fins < 8; ++fins) {
    TriangleSoup soup;
    for (std::size_t i = 0; i < fins; ++i) {
      const float angle = static_cast<float>(i);
      shapes::append(soup, {0, 0, 0}, {0, 0, 1}, {std::cos(angle), std::sin(angle), 0});
    }
    const Mesh mesh = build_mesh(soup);
    std::multiset<std::uint32_t> at;
    std::size_t count = 0;
    for (const Edge& edge : mesh.topology->edges) {
      const Vec3f a = mesh.vertices[edge.vertices[0]], b = mesh.vertices[edge.vertices[1]];
      if (a.x != 0 || b.x != 0 || a.y != 0 || b.y != 0) continue;
      ++count;
      for (const std::uint32_t triangle : edge.triangles)
        if (triangle != kNone) at.insert(triangle);
    }
    EXPECT_EQ(count, (fins + 1) / 2);
    EXPECT_EQ(at.size(), fins);
    EXPECT_EQ(std::set<std::uint32_t>(at.begin(), at.end()).size(), fins);
  }
}

TEST(Edges, OfATriangleOfNoAreaAreCastToo) {
  TriangleSoup soup;
  shapes::append(soup, {0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  EXPECT_EQ(build_mesh(soup).topology->edges.size(), 3u);
}

// By where they are and what they are between.
TEST(Edges, DoNotDependOnTheOrderOfTheTriangles) {
  using Side = std::array<float, 9>;
  const auto described = [](const Mesh& mesh) {
    std::set<std::pair<std::set<Side>, std::array<float, 6>>> result;
    for (const Edge& edge : mesh.topology->edges) {
      std::set<Side> sides;
      for (const std::uint32_t t : edge.triangles) {
        if (t == kNone) continue;
        std::array<Vec3f, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
          corners[k] = mesh.vertices[mesh.topology->triangles[t][k]];
        std::sort(corners.begin(), corners.end(), [](Vec3f a, Vec3f b) {
          return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
        });
        const auto& [p, q, r] = corners;
        sides.insert({p.x, p.y, p.z, q.x, q.y, q.z, r.x, r.y, r.z});
      }
      const Vec3f a = mesh.vertices[edge.vertices[0]], b = mesh.vertices[edge.vertices[1]];
      result.insert({sides, {a.x, a.y, a.z, b.x, b.y, b.z}});
    }
    return result;
  };
  for (const TriangleSoup& soup : manifolds()) {
    TriangleSoup reversed;
    for (std::size_t i = soup.size(); i > 0; i -= 3)
      reversed.insert(reversed.end(), {soup[i - 2], soup[i - 1], soup[i - 3]});
    EXPECT_EQ(described(build_mesh(soup)), described(build_mesh(reversed)));
  }
}

}  // namespace
}  // namespace ode_ext
