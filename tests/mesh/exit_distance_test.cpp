// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/exit_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shapes.h"

namespace ode_ext {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Exits, OfACubesCornersAreAtTheOppositeCorners) {
  for (unsigned cut = 0; cut < 64; ++cut) {
    const Mesh mesh = build_mesh(shapes::box({0, 0, 0}, {1, 1, 1}, 1, cut));
    for (const float exit : mesh.exits) EXPECT_NEAR(exit, std::sqrt(3.0f), 1e-6f);
  }
}

TEST(Exits, OfASphereAreItsDiameter) {
  const Mesh mesh = build_mesh(shapes::sphere(1, 40));
  // The facets lie at most 1 - cos(4.5 deg / 2) * cos(4.5 deg / 2) = 0.0016 inside the sphere, and
  // a normal off by 0.04 shortens the chord to 2 * cos(0.04) = 1.9984.
  for (const float exit : mesh.exits) {
    EXPECT_GT(exit, 2 - 0.0016f - 0.0016f);
    EXPECT_LT(exit, 2.000001f);
  }
}

TEST(Exits, OfAThinPlateAreItsThickness) {
  const float thickness = 0.01f;
  const Mesh mesh = build_mesh(shapes::box({0, 0, 0}, {1, 1, thickness}, 8));
  int checked = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (std::fabs(mesh.normals[i].z) < 0.999f) continue;
    EXPECT_NEAR(mesh.exits[i], thickness, 1e-8f);
    ++checked;
  }
  EXPECT_EQ(checked, 2 * 7 * 7);
}

TEST(Exits, OfACavityLeadThroughTheWall) {
  const TriangleSoup cavity =
      shapes::turned(shapes::box({0.25f, 0.25f, 0.25f}, {0.75f, 0.75f, 0.75f}));
  const Mesh mesh = build_mesh(shapes::joined(shapes::cube(), cavity));
  for (const float exit : mesh.exits) EXPECT_NEAR(exit, 0.25f * std::sqrt(3.0f), 1e-6f);
}

TEST(Exits, OfAnOpenSheetAreItsThickness) {
  const TriangleSoup sheet = shapes::sheet(4);
  const Mesh by_default = build_mesh(sheet);
  EXPECT_NEAR(by_default.mean_edge, 0.25f * (2 + std::sqrt(2.0f)) / 3, 1e-6f);
  for (const float exit : by_default.exits) EXPECT_EQ(exit, by_default.mean_edge);
  for (const float exit : build_mesh(sheet, {.open_thickness = 0.125f}).exits)
    EXPECT_EQ(exit, 0.125f);
}

TEST(Exits, OfAnOpenMeshEndAtItsOtherSide) {
  TriangleSoup soup = shapes::box({0, 0, 0}, {1, 1, 0.01f}, 4);
  soup.resize(soup.size() - 3);
  const Mesh mesh = build_mesh(soup, {.open_thickness = 0.5f});
  ASSERT_FALSE(mesh.closed());
  int thin = 0;
  for (const float exit : mesh.exits) {
    EXPECT_LE(exit, 0.5f);
    thin += exit < 0.02f;
  }
  EXPECT_GT(thin, 2 * 3 * 3 - 3);  // all inner vertices but those at the missing triangle
}

TEST(Exits, PassOverAFaceTheVertexLiesOn) {
  // A small box glued onto a large one: its lower corners lie on the large one's top, which their
  // rays, going up, leave at once. Their own box is where they are inside.
  const TriangleSoup soup = shapes::joined(shapes::box({-4, -4, -1}, {4, 4, 0}),
                                           shapes::box({-1, -1.5f, 0}, {1, 0.5f, 2}));
  const Mesh mesh = build_mesh(soup);
  ASSERT_TRUE(mesh.closed());
  int checked = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (mesh.vertices[i].z != 0 || std::fabs(mesh.vertices[i].x) != 1) continue;
    EXPECT_NEAR(mesh.exits[i], 2 * std::sqrt(3.0f), 1e-5f);
    ++checked;
  }
  EXPECT_EQ(checked, 4);
}

// A car and its engine: the ray enters and leaves the part within before it leaves the other.
TEST(Exits, GoThroughAPartWithinAnother) {
  const TriangleSoup soup =
      shapes::joined(shapes::cube(), shapes::box({0.25f, 0.25f, 0.25f}, {0.75f, 0.75f, 0.75f}));
  const Mesh mesh = build_mesh(soup);
  ASSERT_TRUE(mesh.closed());
  int checked = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const float x = (mesh.vertices[i] + mesh.origin).x;
    if (x != 0 && x != 1) continue;
    EXPECT_NEAR(mesh.exits[i], std::sqrt(3.0f), 1e-6f);
    ++checked;
  }
  EXPECT_EQ(checked, 8);
}

// A tower of two blocks: where one ends the other begins, and it is solid all the same.
TEST(Exits, GoThroughPartsThatAbut) {
  const Mesh mesh = build_mesh(shapes::joined(shapes::box({0, 0, 0}, {4, 4, 1}, 4),
                                              shapes::box({0.5f, 0.5f, 1}, {3.5f, 3.5f, 3})));
  ASSERT_TRUE(mesh.closed());
  int checked = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3f at = mesh.vertices[i] + mesh.origin;
    if (at.z != 0 || std::fabs(mesh.normals[i].z) < 0.999f) continue;
    EXPECT_NEAR(mesh.exits[i], 3, 1e-5f);
    ++checked;
  }
  EXPECT_EQ(checked, 9);
}

TEST(Exits, AreZeroWithoutANormal) {
  const Mesh mesh =
      build_mesh(TriangleSoup{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {.open_thickness = 1});
  for (const float exit : mesh.exits) EXPECT_EQ(exit, 0);
}

TEST(Exits, ThatMeetNothingAreInfinite) {
  const std::vector<Vec3f> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const std::vector<Vec3f> normals(3, Vec3f{0, 0, 1});
  const Bvh bvh = build_bvh(vertices, triangles);
  EXPECT_EQ(exit_distances(vertices, normals, triangles, bvh),
            (std::vector<float>{kInfinity, kInfinity, kInfinity}));
}

// A cube on another, which is cut more finely: the ray from a corner leaves the first by the corner
// where the second begins.
TEST(Exits, ByACornerOfTwoPartsAreThere) {
  const TriangleSoup soup =
      shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}, 1), shapes::box({0, 0, 1}, {1, 1, 2}, 2));
  const Mesh mesh = build_mesh(soup);
  ASSERT_EQ(mesh.topology->triangles.size(), soup.size() / 3);
  std::size_t found = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3f place = mesh.vertices[v] + mesh.origin;
    if (place.z != 0 || (place.x != 0 && place.x != 1) || (place.y != 0 && place.y != 1)) continue;
    EXPECT_NEAR(mesh.exits[v], std::sqrt(3), 1e-6);
    ++found;
  }
  EXPECT_EQ(found, 4u);
}

TEST(Exits, ThatMeetAFrontFaceFirstAreInfinite) {
  // A vertex above two faces that look up at it, one below the other, the lower one turned down.
  const std::vector<Vec3f> vertices{{0, 0, 5},   {-1, -1, 3}, {1, -1, 3}, {0, 1, 3},
                                    {-1, -1, 1}, {1, -1, 1},  {0, 1, 1}};
  const std::vector<Vec3f> normals(vertices.size(), Vec3f{0, 0, 1});
  const auto exit_of_first = [&](const std::vector<Triangle>& triangles) {
    return exit_distances(vertices, normals, triangles, build_bvh(vertices, triangles))[0];
  };
  EXPECT_EQ(exit_of_first({{1, 2, 3}, {4, 6, 5}}), kInfinity);  // and leaves what it entered alone
  EXPECT_EQ(exit_of_first({{1, 3, 2}, {4, 5, 6}}), 2);
  EXPECT_EQ(exit_of_first({{4, 6, 5}}), 4);
}

}  // namespace
}  // namespace ode_ext
