// SPDX-License-Identifier: BSD-3-Clause
#include "reference/reference_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ode_ext::test {
namespace {

constexpr double kMeshTight = 1e-12;  // a few operations on doubles of order one

TEST(ReferenceMesh, WeldsASoupToTheVerticesOfTheIndexedMesh) {
  const ReferenceMesh cube = reference_mesh(unshared(make_cube(2)));
  EXPECT_EQ(cube.vertices.size(), 8u);
  EXPECT_EQ(cube.triangles.size(), 12u);
  EXPECT_TRUE(cube.closed);
}

// Weighting by angle makes the normal of a corner independent of how its faces are cut.
TEST(ReferenceMesh, GivesCubeCornersDiagonalNormals) {
  const ReferenceMesh cube = reference_mesh(make_cube(2));
  for (std::size_t v = 0; v < 8; ++v) {
    EXPECT_LT(distance(cube.normals[v], unit(cube.vertices[v])), kMeshTight);
  }
}

TEST(ReferenceMesh, ExitsACubeAtTheOppositeCorner) {
  const ReferenceMesh cube = reference_mesh(make_cube(2));
  for (const double exit : cube.exits) EXPECT_NEAR(exit, 2 * std::sqrt(3.0), kMeshTight);
}

TEST(ReferenceMesh, ExitsAPlateThroughItsThickness) {
  const ReferenceMesh plate = reference_mesh(make_plate(4, 0.5, 4));
  int inner = 0;
  for (std::size_t v = 0; v < plate.vertices.size(); ++v) {
    const Point& p = plate.vertices[v];
    if (std::fabs(p[0]) > 1.5 || std::fabs(p[1]) > 1.5) continue;
    EXPECT_NEAR(plate.exits[v], 0.5, kMeshTight);
    ++inner;
  }
  EXPECT_EQ(inner, 18);  // 3 x 3 on both faces
}

TEST(ReferenceMesh, TurnsAnInvertedClosedMeshOutwards) {
  const ReferenceMesh cube = reference_mesh(inverted(make_cube(2)));
  EXPECT_TRUE(cube.inverted);
  for (std::size_t v = 0; v < 8; ++v) {
    EXPECT_LT(distance(cube.normals[v], unit(cube.vertices[v])), kMeshTight);
  }
}

TEST(ReferenceMesh, BoundsTheExitsOfAnOpenMeshByItsMeanEdge) {
  const ReferenceMesh sheet = reference_mesh(make_sheet(2, 2));
  EXPECT_FALSE(sheet.closed);
  // Eight quads' triangles: two sides of 1 and a diagonal each.
  EXPECT_NEAR(sheet.mean_edge, (2 + std::sqrt(2.0)) / 3, kMeshTight);
  for (const double exit : sheet.exits) EXPECT_EQ(exit, sheet.mean_edge);
  for (const double exit : reference_mesh(make_sheet(2, 2), 0.25).exits) EXPECT_EQ(exit, 0.25);
}

TEST(ReferenceMesh, LeavesOutCollapsedTrianglesButKeepsTheirNumbers) {
  TestMesh mesh = make_cube(2);
  mesh.indices.insert(mesh.indices.begin(), {0, 0, 1});
  const ReferenceMesh cube = reference_mesh(mesh);
  EXPECT_EQ(cube.triangles.size(), 12u);
  EXPECT_EQ(cube.source_triangle.front(), 1);
  EXPECT_TRUE(cube.closed);
}

TEST(ReferenceMesh, IsNotClosedWhereThreeTrianglesShareAnEdge) {
  TestMesh fin = merged(make_cube(2), make_triangle(1));
  EXPECT_FALSE(reference_mesh(fin).closed);
}

TEST(Crossings, CountBothNeighboursOfAnEdgeThatIsHitExactly) {
  const ReferenceMesh cube = reference_mesh(make_cube(2));
  const auto hits = crossings(cube, {0, 0, 3}, {0, 0, -1}, 0);  // the diagonals of two faces
  ASSERT_EQ(hits.size(), 4u);
  EXPECT_NEAR(hits[0].t, 2, kMeshTight);
  EXPECT_LT(hits[0].facing, 0);
  EXPECT_NEAR(hits[3].t, 4, kMeshTight);
  EXPECT_GT(hits[3].facing, 0);
}

}  // namespace
}  // namespace ode_ext::test
