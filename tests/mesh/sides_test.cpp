// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesh/edge_pairs.h"
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

// A plate of eight triangles, all one facet, and on one of their sides a triangle upright.
TriangleSoup plate_with_a_fin(std::size_t side) {
  TriangleSoup soup = shapes::sheet(2);
  const std::size_t first = side - side % 3;
  const Vec3f a = soup[side], b = soup[first + (side + 1) % 3];
  soup.insert(soup.end(), {a, b, 0.5f * a + 0.5f * b + Vec3f{0, 0, 1}});
  return soup;
}

std::vector<TriangleSoup> soups_with_sides() {
  std::vector<TriangleSoup> all{shapes::sheet(4),
                                shapes::joined(shapes::cube(), shapes::box({1, 1, 0}, {2, 2, 1}))};
  for (std::size_t side = 0; side < 24; ++side) all.push_back(plate_with_a_fin(side));
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
    std::vector<HalfEdge> half_edges = half_edges_of(built.triangles);
    pair_by_solids(mesh.vertices, built.triangles, half_edges);
    const auto across = neighbours(built.triangles.size(), half_edges);
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

// Where two of the plate's and the fin meet, the two are of one facet, and yet no neighbours.
TEST(Sides, AtAnEdgeWhereAFinStandsAreOfNoNeighbours) {
  std::size_t feet = 0;
  for (std::size_t side = 0; side < 24; ++side) {
    const Mesh mesh = build_mesh(plate_with_a_fin(side));
    const MeshTopology& built = *mesh.topology;
    std::map<std::set<std::uint32_t>, std::vector<std::pair<std::uint32_t, std::size_t>>> at;
    for (std::uint32_t t = 0; t < built.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        at[ends_of_side(built.triangles[t], k)].emplace_back(t, k);
    for (const auto& [ends, sides] : at) {
      if (sides.size() < 3) continue;
      for (const auto& [t, k] : sides) {
        const std::uint32_t found = built.sides[t][k];
        EXPECT_TRUE(is_edge(found) || found == kNone);
        for (const auto& [other, i] : sides)
          feet += other != t && built.facets[other] == built.facets[t] ? 1 : 0;
      }
    }
  }
  EXPECT_GT(feet, 0u);
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
