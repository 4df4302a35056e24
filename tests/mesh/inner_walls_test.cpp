// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/inner_walls.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/voxels.h"

namespace ode_ext {
namespace {

using shapes::Cell;

bool is_used(const Mesh& mesh, std::uint32_t vertex) {
  return std::any_of(
      mesh.topology->triangles.begin(), mesh.topology->triangles.end(),
      [&](const Triangle& t) { return std::find(t.begin(), t.end(), vertex) != t.end(); });
}

TEST(InnerWalls, OfVoxelsAreLeftOut) {
  std::size_t walls = 0;
  for (std::uint32_t seed = 1; seed <= 40; ++seed) {
    const std::set<Cell> cells = shapes::random_cells(3, seed);
    const TriangleSoup soup = shapes::voxels(cells);
    for (const bool inverted : {false, true}) {
      const Mesh mesh = build_mesh(inverted ? shapes::turned(soup) : soup);
      EXPECT_EQ(mesh.topology->triangles.size(), 2 * shapes::outer_sides(cells)) << seed;
      EXPECT_TRUE(mesh.closed()) << seed;
      EXPECT_EQ(mesh.topology->inverted, inverted) << seed;
      EXPECT_DOUBLE_EQ(shapes::volume(mesh), static_cast<double>(cells.size())) << seed;
      walls += soup.size() / 3 - mesh.topology->triangles.size();
    }
  }
  EXPECT_GT(walls, 4000u);
}

// Whichever diagonals they are cut by, and however finely.
TEST(InnerWalls, OfBoxesCutByOtherDiagonalsAreLeftOut) {
  std::mt19937 random(2);
  for (const int steps : {1, 2, 5})
    for (int i = 0; i < 20; ++i) {
      TriangleSoup soup;
      for (const float x : {0.f, 1.f, 2.f})
        soup = shapes::joined(soup, shapes::box({x, 0, 0}, {x + 1, 1, 1}, steps, random() % 64));
      const Mesh mesh = build_mesh(soup);
      EXPECT_EQ(mesh.topology->triangles.size(), static_cast<std::size_t>(14 * 2 * steps * steps));
      EXPECT_TRUE(mesh.closed());
      EXPECT_NEAR(shapes::volume(mesh), 3, 1e-13);
    }
}

// Only as a whole does one cover the other.
TEST(InnerWalls, OfWhichOneIsCutOtherwiseStay) {
  const TriangleSoup soup =
      shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}, 1), shapes::box({1, 0, 0}, {2, 1, 1}, 2));
  const Mesh mesh = build_mesh(soup);
  EXPECT_EQ(mesh.topology->triangles.size(), soup.size() / 3);
  EXPECT_TRUE(mesh.closed());
}

TEST(InnerWalls, TakeVerticesWithThemThatAreOfNothingElse) {
  std::set<Cell> block;
  for (int i = 0; i < 27; ++i) block.insert({i % 3, i / 3 % 3, i / 9});
  const Mesh mesh = build_mesh(shapes::voxels(block));
  EXPECT_EQ(mesh.vertices.size(), 56u);  // of 4^3 all but the 2^3 inside
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) EXPECT_TRUE(is_used(mesh, v));
}

// side1 and side2 are the program's numbers.
TEST(InnerWalls, LeaveTheOthersTheirNumbers) {
  const TriangleSoup soup = shapes::voxels({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}});
  const Mesh mesh = build_mesh(soup);
  ASSERT_EQ(mesh.topology->triangles.size(), 36u);
  for (std::size_t t = 0; t < mesh.topology->triangles.size(); ++t) {
    Triangle triangle = mesh.topology->triangles[t];
    Mesh as_given = mesh;
    for (Vec3f& vertex : as_given.vertices) vertex = vertex + mesh.origin;
    EXPECT_TRUE(shapes::is_triangle_of(soup, mesh.topology->source_triangle[t], as_given, triangle))
        << t;
  }
}

TEST(InnerWalls, AreNoSheetsOfTwoSides) {
  const TriangleSoup sheet = shapes::joined(shapes::sheet(3), shapes::turned(shapes::sheet(3)));
  const Mesh alone = build_mesh(sheet);
  EXPECT_EQ(alone.topology->triangles.size(), 36u);
  EXPECT_FALSE(alone.closed());
  const Mesh beside = build_mesh(shapes::joined(sheet, shapes::box({3, 0, 0}, {4, 1, 1})));
  EXPECT_EQ(beside.topology->triangles.size(), 48u);
  EXPECT_FALSE(beside.closed());
}

// What is no solid has no inside for a wall to be in.
TEST(InnerWalls, StayInWhatIsOpen) {
  TriangleSoup soup = shapes::voxels({{0, 0, 0}, {1, 0, 0}});
  soup.resize(soup.size() - 3);
  const Mesh mesh = build_mesh(soup);
  EXPECT_EQ(mesh.topology->triangles.size(), 23u);
  EXPECT_FALSE(mesh.closed());
}

TEST(InnerWalls, OfMeshesThatDeformStay) {
  const Mesh mesh = build_mesh(shapes::voxels({{0, 0, 0}, {1, 0, 0}}), {.deformable = true});
  EXPECT_EQ(mesh.topology->triangles.size(), 24u);
}

}  // namespace
}  // namespace ode_ext
