// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

#include "mesh/edges.h"
#include "mesh/half_edges.h"
#include "mesh/mesh.h"
#include "mesh/neighbours.h"
#include "mesh/shapes.h"
#include "support/test_scene.h"

namespace ode_ext {
namespace {

using test::soup_of;

std::set<std::uint32_t> ends_of_side(const Triangle& triangle, std::size_t k) {
  return {triangle[k], triangle[(k + 1) % 3]};
}

bool is_edge(std::uint32_t side) { return (side & kWithinFacet) == 0; }

// Of each edge the triangles that name it at a side with its ends.
std::vector<std::multiset<std::uint32_t>> triangles_at_edges(const MeshTopology& built) {
  std::vector<std::multiset<std::uint32_t>> at(built.edges.size());
  for (std::uint32_t t = 0; t < built.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t side = built.sides[t][k];
      if (!is_edge(side)) continue;
      const auto& ends = built.edges.at(side).vertices;
      EXPECT_EQ(ends_of_side(built.triangles[t], k),
                (std::set<std::uint32_t>(ends.begin(), ends.end())));
      at[side].insert(t);
    }
  return at;
}

// A plate of two triangles, and on the side that they have in common one upright.
TriangleSoup plate_with_a_fin() {
  return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0},      {1, 1, 0},
          {0, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0.5f, 0.5f, 1}};
}

std::vector<TriangleSoup> soups_with_sides() {
  std::vector<TriangleSoup> all{shapes::sheet(4),
                                shapes::joined(shapes::cube(), shapes::box({1, 1, 0}, {2, 2, 1}))};
  all.push_back(plate_with_a_fin());
  for (const test::TestMesh& made : test::small_meshes()) all.push_back(soup_of(made));
  all.push_back(soup_of(test::make_cube(1, 4)));
  return all;
}

TEST(Sides, NameTheEdgesOfWhichEachTriangleIsOne) {
  for (const TriangleSoup& soup : soups_with_sides())
    for (const bool deformable : {false, true}) {
      const Mesh mesh = build_mesh(soup, {.deformable = deformable});
      const auto found = triangles_at_edges(*mesh.topology);
      for (std::size_t i = 0; i < found.size(); ++i) {
        std::multiset<std::uint32_t> expected;
        for (const std::uint32_t t : mesh.topology->edges[i].triangles)
          if (t != kNone) expected.insert(t);
        EXPECT_EQ(found[i], expected);
      }
    }
}

TEST(Sides, NameTheNeighbourAcrossWithinAFacet) {
  std::size_t within = 0;
  for (const TriangleSoup& soup : soups_with_sides()) {
    const Mesh mesh = build_mesh(soup);
    const MeshTopology& built = *mesh.topology;
    const auto across = neighbours(built.triangles.size(), half_edges_of(built.triangles));
    for (std::uint32_t t = 0; t < built.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t next = across[t][k], side = built.sides[t][k];
        const bool is_within = next != kNone && built.facets[next] == built.facets[t];
        within += is_within ? 1 : 0;
        if (is_within)
          EXPECT_EQ(side, next | kWithinFacet);
        else
          EXPECT_TRUE(is_edge(side) || side == kNone);
      }
  }
  EXPECT_GT(within, 500u);
}

// Two of the plate's, and the fin, meet: the two are of one facet, and no neighbours.
TEST(Sides, AtAnEdgeWhereAFinStandsAreOfNoNeighbours) {
  const Mesh mesh = build_mesh(plate_with_a_fin());
  const MeshTopology& built = *mesh.topology;
  const auto found = std::find_if(built.edges.begin(), built.edges.end(), [&](const Edge& edge) {
    return mesh.vertices[edge.vertices[0]].z + mesh.vertices[edge.vertices[1]].z > 0.9f;
  });
  ASSERT_NE(found, built.edges.end());
  const std::uint32_t fin = found->triangles[0];
  std::size_t feet = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto ends = ends_of_side(built.triangles[fin], k);
    if (std::any_of(ends.begin(), ends.end(), [&](auto v) { return mesh.vertices[v].z > 0.5f; }))
      continue;
    for (std::uint32_t t = 0; t < built.triangles.size(); ++t)
      for (std::size_t i = 0; i < 3; ++i)
        if (t != fin && ends_of_side(built.triangles[t], i) == ends) {
          ++feet;
          EXPECT_TRUE(is_edge(built.sides[t][i]) || built.sides[t][i] == kNone);
        }
  }
  EXPECT_EQ(feet, 2u);
}

TEST(Sides, AreOfEdgesAloneWhereAMeshDeforms) {
  const Mesh mesh = build_mesh(soup_of(test::make_cube(1, 4)), {.deformable = true});
  for (const Sides& sides : mesh.topology->sides)
    EXPECT_TRUE(std::all_of(sides.begin(), sides.end(), is_edge));
}

// Two triangles of one plane that run their common side the same way are no neighbours, but of two
// facets: there is an edge.
TEST(Sides, ThatAreRunTheSameWayTwiceAreEdges) {
  const std::vector<Vec3f> places{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 1, 3}};
  const std::vector<std::uint32_t> facets{0, 1};
  const auto sides = find_edges(places, half_edges_of(triangles), facets).sides;
  EXPECT_TRUE(is_edge(sides[0][0]));
  EXPECT_EQ(sides[0][0], sides[1][0]);
}

// Of one facet, they are neither.
TEST(Sides, OfOneFacetThatAreNoNeighboursHaveNothing) {
  const std::vector<Vec3f> places{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}, {0, 1, 3}};
  const std::vector<std::uint32_t> facets{0, 0};
  const auto sides = find_edges(places, half_edges_of(triangles), facets).sides;
  EXPECT_EQ(sides[0][0], kNone);
  EXPECT_EQ(sides[1][0], kNone);
  EXPECT_TRUE(is_edge(sides[0][1]));
}

}  // namespace
}  // namespace ode_ext
