// SPDX-License-Identifier: BSD-3-Clause
#include "support/mesh_makers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

namespace ode_ext::test {
namespace {

double volume(const TestMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    sum += dot(mesh.corner(t, 0), cross(mesh.corner(t, 1), mesh.corner(t, 2))) / 6;
  }
  return sum;
}

bool every_edge_has_its_opposite(const TestMesh& mesh) {
  std::map<std::pair<unsigned, unsigned>, int> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    ++edges[{mesh.indices[i], mesh.indices[i % 3 == 2 ? i - 2 : i + 1]}];
  }
  for (const auto& [edge, count] : edges) {
    const auto opposite = edges.find({edge.second, edge.first});
    if (count != 1 || opposite == edges.end()) return false;
  }
  return true;
}

struct Solid {
  std::string name;
  TestMesh mesh;
  int triangles;
  double volume, tolerance;
};

TEST(MeshMakers, MakeClosedOutwardSolidsOfTheRightVolume) {
  constexpr double pi = std::numbers::pi;
  const double exact = 1e-6;  // float vertices: a few times 2^-24 of volumes of order one
  const std::vector<Solid> solids{
      {"cube", make_cube(2, 3), 108, 8, exact * 8},
      {"plate", make_plate(2, 0.5, 4), 2 * 16 * 2 + 4 * 4 * 2, 2, exact * 2},
      {"rod", make_rod(4, 0.5), 12, 1, exact},
      // Inscribed polyhedra are smaller; 1280 triangles lose 1 %, 24 x 16 quads 4 %.
      {"sphere", make_icosphere(1, 3), 1280, 4 * pi / 3, 0.05},
      {"torus", make_torus(1, 0.4, 24, 16), 768, 2 * pi * pi * 0.16, 0.13},
      {"tetrahedron", make_tetrahedron(1), 4, 1 / (6 * std::sqrt(2.0)), exact},
      {"cylinder", make_cylinder(1, 2, 100), 400, 100 * std::sin(2 * pi / 100), exact * 8},
      {"L", make_l(2), 20, 3, exact * 3},
      // 5 + 3 cells of 0.2 x 0.2 and 0.2 x 0.5, 0.4 deep; 18 walls.
      {"comb", make_comb(3, 0.2, 0.5, 0.4), 8 * 4 + 18 * 2, 0.4 * (5 * 0.04 + 3 * 0.1), exact},
  };
  for (const Solid& solid : solids) {
    EXPECT_EQ(solid.mesh.triangle_count(), solid.triangles) << solid.name;
    EXPECT_TRUE(every_edge_has_its_opposite(solid.mesh)) << solid.name;
    EXPECT_NEAR(volume(solid.mesh), solid.volume, solid.tolerance) << solid.name;
    EXPECT_NEAR(volume(inverted(solid.mesh)), -volume(solid.mesh), 1e-12) << solid.name;
    EXPECT_NEAR(volume(unshared(solid.mesh)), volume(solid.mesh), 1e-12) << solid.name;
  }
}

TEST(MeshMakers, MakeOpenSheetsThatAreNotClosed) {
  EXPECT_FALSE(every_edge_has_its_opposite(make_sheet(1, 3)));
  EXPECT_EQ(make_sheet(1, 3).triangle_count(), 18);
  EXPECT_EQ(make_triangle(1).triangle_count(), 1);
}

TEST(MeshMakers, MergeKeepsBothMeshes) {
  const TestMesh two = merged(make_cube(1), moved(make_tetrahedron(1), {3, 0, 0}));
  EXPECT_EQ(two.triangle_count(), 16);
  EXPECT_NEAR(volume(two), 1 + 1 / (6 * std::sqrt(2.0)), 1e-5);
}

TEST(Poses, TurnAPointAboutAnAxisCounterClockwise) {
  const TestPose pose = turned({0, 0, 2}, std::numbers::pi / 2, {10, 20, 30});
  EXPECT_LT(distance(to_world(pose, {1, 0, 0}), {10, 21, 30}), 1e-14);
  EXPECT_LT(distance(to_local(pose, {10, 21, 30}), {1, 0, 0}), 1e-14);
}

TEST(Poses, ComposeLikeApplyingOneAfterTheOther) {
  Random random(1);
  const TestPose outer = random.pose(2), inner = random.pose(2);
  const Point p{0.3, -0.7, 0.9};
  EXPECT_LT(distance(to_world(composed(outer, inner), p), to_world(outer, to_world(inner, p))),
            1e-14);
}

TEST(Poses, OfTheRandomGeneratorAreRotations) {
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const TestPose pose = random.pose(1);
    const Point x = rotate(pose, {1, 0, 0}), y = rotate(pose, {0, 1, 0});
    EXPECT_NEAR(length(x), 1, 1e-14);
    EXPECT_NEAR(dot(x, y), 0, 1e-14);
    EXPECT_LT(distance(cross(x, y), rotate(pose, {0, 0, 1})), 1e-14);  // not a reflection
  }
}

// The first outputs for seed 0, as published with the generator.
TEST(Random, IsSplitmix64) {
  Random random(0);
  EXPECT_EQ(random.next(), 0xe220a8397b1dcdafull);
  EXPECT_EQ(random.next(), 0x6e789e6aa1b965f4ull);
}

}  // namespace
}  // namespace ode_ext::test
