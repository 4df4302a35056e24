// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesh/box.h"
#include "mesh/vertex_chunks.h"
#include "shapes.h"

namespace ode_ext {
namespace {

TEST(Weld, MergesVerticesThatAreExactlyEqual) {
  const WeldedMesh mesh = weld(shapes::cube());
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
}

TEST(Weld, KeepsVerticesApartThatDifferInTheLastBit) {
  const float next = std::nextafter(1.0f, 2.0f);
  const WeldedMesh mesh =
      weld(TriangleSoup{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {next, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(mesh.vertices.size(), 4u);
}

TEST(Weld, TakesNegativeZeroForZero) {
  const WeldedMesh mesh =
      weld(TriangleSoup{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, 0, -0.0f}, {0, 1, 0}, {-1, 0, 0}});
  ASSERT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles[0][0], mesh.triangles[1][0]);
}

TEST(Weld, StoresNegativeZeroAsZero) {
  const WeldedMesh mesh =
      weld(TriangleSoup{{-0.0f, -0.0f, 1}, {-0.0f, 1, -0.0f}, {1, -0.0f, -0.0f}});
  ASSERT_EQ(mesh.vertices.size(), 3u);
  for (const Vec3f& vertex : mesh.vertices) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_FALSE(vertex[axis] == 0 && std::signbit(vertex[axis]));
    }
  }
}

TEST(Weld, DropsTrianglesThatCollapseAndTheirVertices) {
  const Vec3f a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, alone{9, 9, 9};
  const WeldedMesh mesh =
      weld(TriangleSoup{alone, alone, a, a, b, c, b, a, b, alone, alone, alone, a, c, b});
  EXPECT_EQ(mesh.source_triangle, (std::vector<std::uint32_t>{1, 4}));
  EXPECT_EQ(mesh.vertices.size(), 3u);
}

TEST(Weld, KeepsSliversWithThreeDifferentCorners) {
  const WeldedMesh mesh = weld(TriangleSoup{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

TEST(Weld, TakesAnEmptySoup) {
  const WeldedMesh mesh = weld({});
  EXPECT_TRUE(mesh.vertices.empty() && mesh.triangles.empty() && mesh.source_triangle.empty());
}

TEST(Weld, OrdersVerticesByPlaceWhateverTheOrderOfTheTriangles) {
  const TriangleSoup soup = shapes::torus(1, 0.3, 20);
  std::vector<std::size_t> order(soup.size() / 3);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  TriangleSoup shuffled;
  for (const std::size_t i : order) {
    shapes::append(shuffled, soup[3 * i + 1], soup[3 * i + 2], soup[3 * i]);
  }
  EXPECT_EQ(weld(soup).vertices, weld(shuffled).vertices);
}

TEST(Weld, TellsVerticesApartThatAreVeryNear) {
  const WeldedMesh mesh =
      weld(TriangleSoup{{0, 0, 0}, {1e-9f, 0, 0}, {1, 1, 1}, {1e-9f, 0, 0}, {0, 0, 0}, {1, 0, 0}});
  ASSERT_EQ(mesh.vertices.size(), 4u);
  for (const Vec3f place : {Vec3f{0, 0, 0}, Vec3f{1e-9f, 0, 0}})
    EXPECT_EQ(std::count(mesh.vertices.begin(), mesh.vertices.end(), place), 1);
}

// The soup of the same triangles in another order, and where each was listed before.
TEST(Weld, NumbersTrianglesAlikeInWhateverOrderTheyAreListed) {
  const std::vector<Vec3f> soup = shapes::sphere(1, 12);
  const std::size_t count = soup.size() / 3;
  WeldedMesh mesh = weld(soup);
  order_by_vertices(mesh);
  for (const std::size_t step : {7u, 11u, 13u}) {
    ASSERT_NE(count % step, 0u);
    std::vector<Vec3f> other;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < 3; ++k) other.push_back(soup[3 * (i * step % count) + k]);
    WeldedMesh shuffled = weld(other);
    EXPECT_NE(shuffled.triangles, mesh.triangles);
    order_by_vertices(shuffled);
    EXPECT_EQ(shuffled.triangles, mesh.triangles);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      EXPECT_EQ(shuffled.source_triangle[i] * step % count, mesh.source_triangle[i]);
  }
}

TEST(Chunks, HoldEveryVertexOnceInTightBoxes) {
  for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 128u, 1234u}) {
    std::vector<Vec3f> vertices = shapes::random_soup(count, 7);
    vertices.resize(count);
    std::size_t next = 0;
    for (const VertexChunk& chunk : cut_into_chunks(vertices)) {
      EXPECT_EQ(chunk.first, next);
      ASSERT_GE(chunk.count, 1u);
      ASSERT_LE(chunk.count, kChunkVertices);
      const auto first = vertices.begin() + chunk.first;
      const Box tight = box_of(std::vector<Vec3f>(first, first + chunk.count));
      EXPECT_EQ(chunk.box.lo, tight.lo);
      EXPECT_EQ(chunk.box.hi, tight.hi);
      next += chunk.count;
    }
    EXPECT_EQ(next, count);
  }
}

// Deformable meshes: numbers that stay while vertices move.
TEST(Weld, NumbersVerticesByTheListingAloneWhereAskedTo) {
  const TriangleSoup soup = shapes::torus(1, 0.3, 20);
  TriangleSoup moved = soup;
  for (Vec3f& v : moved) v = {v.y - 0.25f * v.x, v.z * v.z * v.z + v.y, v.x};
  const WeldedMesh built = weld(soup, VertexOrder::kListing);
  const WeldedMesh other = weld(moved, VertexOrder::kListing);
  EXPECT_EQ(built.corner_vertex, other.corner_vertex);
  EXPECT_EQ(built.triangles, other.triangles);
  EXPECT_NE(weld(soup).corner_vertex, weld(moved).corner_vertex) << "what runs depend on";
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < soup.size(); ++i) {
    EXPECT_LE(built.corner_vertex[i], next);
    EXPECT_EQ(built.vertices[built.corner_vertex[i]], soup[i] + Vec3f{});
    next = std::max(next, built.corner_vertex[i] + 1);
  }
  EXPECT_EQ(next, built.vertices.size());
}

TEST(Chunks, AreSmallBecauseVerticesComeInRuns) {
  const std::vector<Vec3f> vertices = weld(shapes::sphere(1, 60)).vertices;
  double sum = 0;
  const std::vector<VertexChunk> chunks = cut_into_chunks(vertices);
  for (const VertexChunk& chunk : chunks) sum += length(extent(chunk.box));
  // 16 of 7082 vertices cover 0.028 m^2, a square of diagonal 0.24 m; a run may be twice as long as
  // wide. In random order it would be that of the sphere's box, 3.4 m.
  EXPECT_LT(sum / static_cast<double>(chunks.size()), 0.34);
}

}  // namespace
}  // namespace ode_ext
