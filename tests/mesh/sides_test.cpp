// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <vector>

#include "mesh/edges.h"
#include "mesh/half_edges.h"
#include "mesh/mesh.h"
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

std::vector<TriangleSoup> soups_with_sides() {
  std::vector<TriangleSoup> all{shapes::sheet(4),
                                shapes::joined(shapes::cube(), shapes::box({1, 1, 0}, {2, 2, 1}))};
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

TEST(Sides, NameTheTriangleAcrossWithinAFacet) {
  const Mesh mesh = build_mesh(soup_of(test::make_cube(1, 4)));
  const MeshTopology& built = *mesh.topology;
  std::size_t within = 0;
  for (std::uint32_t t = 0; t < built.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t side = built.sides[t][k];
      if (is_edge(side)) continue;
      ++within;
      const std::uint32_t across = side & ~kWithinFacet;
      EXPECT_EQ(built.facets.at(across), built.facets[t]);
      const auto ends = ends_of_side(built.triangles[t], k);
      for (const std::uint32_t end : ends)
        EXPECT_EQ(std::count(built.triangles[across].begin(), built.triangles[across].end(), end),
                  1);
      const Sides& back = built.sides[across];
      EXPECT_EQ(std::count(back.begin(), back.end(), t | kWithinFacet), 1);
    }
  // All sides but those at the 12 edges of the cube, of 4 steps each, from either face.
  EXPECT_EQ(within, 3 * built.triangles.size() - std::size_t{2 * 12 * 4});
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
