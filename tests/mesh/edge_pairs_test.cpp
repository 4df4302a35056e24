// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/edge_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "mesh/edges.h"
#include "mesh/voxels.h"

namespace ode_ext {
namespace {

using shapes::Cell;

// The cell that a triangle of a world of cells is a side of: the one behind it.
Cell cell_behind(const Mesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.topology->triangles[triangle];
  Vec3d middle{};
  for (const std::uint32_t corner : t)
    middle = middle + (1.0 / 3) * Vec3d(mesh.vertices[corner] + mesh.origin);
  return shapes::cell_of(middle - 0.25 * face_normal(mesh, triangle));
}

std::map<std::array<std::uint32_t, 2>, std::vector<Edge>> edges_by_ends(const Mesh& mesh) {
  std::map<std::array<std::uint32_t, 2>, std::vector<Edge>> edges;
  for (const Edge& edge : mesh.topology->edges) {
    std::array<std::uint32_t, 2> ends = edge.vertices;
    std::sort(ends.begin(), ends.end());
    edges[ends].push_back(edge);
  }
  return edges;
}

TEST(EdgePairs, OfCubesThatTouchAlongAnEdgeAreOfOneCube) {
  std::size_t shared = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    const Mesh mesh = build_mesh(shapes::voxels(shapes::random_cells(3, seed)));
    for (const auto& [ends, edges] : edges_by_ends(mesh)) {
      if (edges.size() == 1) continue;
      ++shared;
      EXPECT_EQ(edges.size(), 2u);
      for (const Edge& edge : edges)
        EXPECT_EQ(cell_behind(mesh, edge.triangles[0]), cell_behind(mesh, edge.triangles[1]))
            << seed;
    }
  }
  EXPECT_GT(shared, 100u);
}

// Boxes side by side that are not level: the walls lie on one another, and
// each box has its own.
TEST(EdgePairs, OfBoxesThatLieOnOneAnotherAreOfOneBox) {
  std::size_t walls = 0;
  for (const float aside : {0.25f, 0.5f, 1e-7f}) {
    TriangleSoup soup = shapes::box({-1, 0, 0}, {0, 1, 1}, 1, 0);
    soup = shapes::joined(soup, shapes::box({0, aside, 0}, {1, 1 + aside, 1}, 1, 63));
    const Mesh mesh = build_mesh(soup);
    EXPECT_EQ(mesh.topology->triangles.size(), 24u);
    EXPECT_TRUE(mesh.closed());
    for (const Edge& edge : mesh.topology->edges) {
      EXPECT_EQ(mesh.topology->source_triangle[edge.triangles[0]] / 12,
                mesh.topology->source_triangle[edge.triangles[1]] / 12);
      ++walls;
    }
  }
  EXPECT_EQ(walls, 72u);
}

TEST(EdgePairs, AreTheSameHoweverTheMeshIsWound) {
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const TriangleSoup soup = shapes::voxels(shapes::random_cells(3, seed));
    const Mesh upright = build_mesh(soup), inverted = build_mesh(shapes::turned(soup));
    ASSERT_EQ(upright.topology->edges.size(), inverted.topology->edges.size());
    for (std::size_t i = 0; i < upright.topology->edges.size(); ++i) {
      EXPECT_EQ(upright.topology->edges[i].vertices, inverted.topology->edges[i].vertices);
      EXPECT_EQ(upright.topology->edges[i].triangles, inverted.topology->edges[i].triangles);
    }
  }
}

TEST(EdgePairs, OfMeshesThatDeformRunTheEdgeBothWays) {
  const Mesh mesh = build_mesh(shapes::voxels({{0, 0, 0}, {1, 1, 0}}), {.deformable = true});
  EXPECT_TRUE(mesh.closed());
  const auto runs = [&](std::uint32_t triangle, std::uint32_t from, std::uint32_t to) {
    const Triangle& t = mesh.topology->triangles[triangle];
    return (t[0] == from && t[1] == to) || (t[1] == from && t[2] == to) ||
           (t[2] == from && t[0] == to);
  };
  for (const Edge& edge : mesh.topology->edges) {
    EXPECT_TRUE(runs(edge.triangles[0], edge.vertices[0], edge.vertices[1]));
    EXPECT_TRUE(runs(edge.triangles[1], edge.vertices[1], edge.vertices[0]));
  }
}

// A book of 100,000 pages takes no longer than as many pages apart.
TEST(EdgePairs, OfVeryManyAtOneEdgeAreFound) {
  const std::uint32_t pages = 50000;
  const std::vector<Vec3f> ends{{0, 0, 0}, {0, 0, 1}};
  std::vector<Vec3f> vertices = ends;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < pages; ++i) {
    const double angle = 6 * static_cast<double>(i) / pages;
    vertices.push_back(Vec3f(Vec3d{std::cos(angle), std::sin(angle), 0}));
    triangles.push_back(i % 2 == 0 ? Triangle{0, i + 2, 1} : Triangle{0, 1, i + 2});
  }
  std::vector<HalfEdge> half_edges = half_edges_of(triangles);
  pair_by_solids(vertices, triangles, half_edges);
  const auto first = std::find_if(half_edges.begin(), half_edges.end(),
                                  [](const HalfEdge& h) { return h.low == 0 && h.high == 1; });
  const auto begin = static_cast<std::size_t>(first - half_edges.begin());
  EXPECT_EQ(end_of_edge(half_edges, begin) - begin, pages);
  EXPECT_TRUE(are_pairs(half_edges, begin, begin + pages));
  for (std::size_t i = begin; i < begin + pages; i += 2)
    EXPECT_EQ(half_edges[i].side / 3 ^ half_edges[i + 1].side / 3, 1u);
  EXPECT_FALSE(has_coincident(triangles, half_edges));
}

}  // namespace
}  // namespace ode_ext
