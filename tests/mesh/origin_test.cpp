// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/origin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/mesh.h"
#include "shapes.h"

namespace ode_ext {
namespace {

// Those of the triangles that were given, as the mesh has them.
void expect_exact(const TriangleSoup& soup, const Mesh& mesh) {
  const MeshTopology& topology = *mesh.topology;
  ASSERT_GT(topology.triangles.size(), 0u);
  for (std::size_t t = 0; t < topology.triangles.size(); ++t)
    for (const std::uint32_t v : topology.triangles[t]) {
      const Vec3d place = Vec3d(mesh.vertices[v]) + Vec3d(mesh.origin);
      const Vec3f* corners = &soup[3 * std::size_t{topology.source_triangle[t]}];
      EXPECT_TRUE(place == Vec3d(corners[0]) || place == Vec3d(corners[1]) ||
                  place == Vec3d(corners[2]))
          << t;
    }
}

TEST(Origin, IsWhereAMeshLiesAndLosesNothing) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> exponent(-3, 20), way(-1, 1);
  int moved = 0;
  for (int i = 0; i < 300; ++i) {
    const float distance = std::exp2(exponent(random));
    const Vec3f far{distance * way(random), distance * way(random), distance * way(random)};
    const TriangleSoup soup = shapes::moved(shapes::random_soup(40, 41), 1, far);
    const Mesh mesh = build_mesh(soup);
    expect_exact(soup, mesh);
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh.origin[k] == 0) continue;
      ++moved;
      const float size = mesh.box.hi[k] - mesh.box.lo[k];
      EXPECT_LE(std::fabs(mesh.box.lo[k]), 0.5f * size + 0x1p-23f * std::fabs(mesh.origin[k]));
      EXPECT_LE(std::fabs(mesh.box.hi[k]), 0.5f * size + 0x1p-23f * std::fabs(mesh.origin[k]));
    }
  }
  EXPECT_GT(moved, 300);
  EXPECT_LT(moved, 900);
}

TEST(Origin, StaysWhereMeshesReachIt) {
  for (const Vec3f lo : {Vec3f{-1, -1, -1}, Vec3f{0, 0, 0}, Vec3f{1, 1, 1}})
    EXPECT_EQ(exact_origin({lo, {7, 7, 7}}), Vec3f{});
  EXPECT_EQ(exact_origin({{-7, 0, 1}, {-1, 0, 7}}), Vec3f{});
}

TEST(Origin, IsOfEachAxisByItself) {
  EXPECT_EQ(exact_origin({{-1, 1000, -1004}, {1, 1004, -1000}}), (Vec3f{0, 1002, -1002}));
}

// Its past would decide how a shape is rounded.
TEST(Origin, OfADeformableMeshIsItsOwn) {
  const TriangleSoup soup = shapes::moved(shapes::sheet(4), 1, {1000, 0, 0});
  EXPECT_EQ(build_mesh(soup, {.deformable = true}).origin, Vec3f{});
  EXPECT_NE(build_mesh(soup).origin, Vec3f{});
}

}  // namespace
}  // namespace ode_ext
