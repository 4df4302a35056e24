// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/normals.h"

#include <gtest/gtest.h>

#include <cmath>

#include "shapes.h"

namespace ode_ext {
namespace {

// A float keeps 24 bits, so each component of a unit normal is right to 2^-24.
constexpr float kRounding = 0x1p-23f;

void expect_near(Vec3f actual, Vec3f expected) {
  EXPECT_NEAR(actual.x, expected.x, kRounding);
  EXPECT_NEAR(actual.y, expected.y, kRounding);
  EXPECT_NEAR(actual.z, expected.z, kRounding);
}

TEST(Normals, OfACubesCornersAreItsDiagonalsHoweverItsSidesAreCut) {
  const float diagonal = 1 / std::sqrt(3.0f);
  for (unsigned cut = 0; cut < 64; ++cut) {
    const Mesh mesh = build_mesh(shapes::box({-1, -1, -1}, {1, 1, 1}, 1, cut));
    ASSERT_EQ(mesh.vertices.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) expect_near(mesh.normals[i], diagonal * mesh.vertices[i]);
  }
}

TEST(Normals, OfASpherePointAwayFromItsCentre) {
  const Mesh mesh = build_mesh(shapes::sphere(2, 40));
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    // Triangles of 4.5 degrees: a vertex normal is off by less than half of one of them.
    EXPECT_GT(dot(mesh.normals[i], 0.5f * mesh.vertices[i]), std::cos(0.04f));
    EXPECT_NEAR(length(mesh.normals[i]), 1, 2 * kRounding);
  }
}

TEST(Normals, FollowTheTurnedWindingOfAnInvertedMesh) {
  const Mesh mesh = build_mesh(shapes::turned(shapes::cube()));
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_GT(dot(mesh.normals[i], mesh.vertices[i] - Vec3f{0.5f, 0.5f, 0.5f}), 0.8f);
  }
  for (std::uint32_t i = 0; i < mesh.topology->triangles.size(); ++i) {
    const Vec3d corner(mesh.vertices[mesh.topology->triangles[i][0]]);
    EXPECT_GT(dot(face_normal(mesh, i), corner - Vec3d{0.5, 0.5, 0.5}), 0.4);
  }
}

TEST(Normals, OfASheetOfTwoSidesAreThoseOfTheLargestFace) {
  const Vec3f a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, far{2, 0, 0};
  const Mesh mesh = build_mesh(TriangleSoup{a, b, c, a, c, far});
  const Vec3f up{0, 0, 1}, down{0, 0, -1};
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    expect_near(mesh.normals[i], mesh.vertices[i] == b ? up : down);
  }
}

TEST(Normals, ThatCancelExactlyDoNotDependOnTheOrderOfTheFaces) {
  const Vec3f a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  const Mesh one = build_mesh(TriangleSoup{a, b, c, a, c, b});
  const Mesh two = build_mesh(TriangleSoup{a, c, b, a, b, c});
  EXPECT_EQ(one.normals, two.normals);
  for (const Vec3f& normal : one.normals) EXPECT_EQ(length(normal), 1);
}

TEST(Normals, ThatCancelButForRoundingAreThoseOfTheLargestFace) {
  // A sheet of two sides that rounding has pulled apart by 1e-8: what is left of the sum points
  // along the sheet.
  const Vec3f a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{1, 0, 1e-8f}, e{0, 1, -1e-8f};
  const Mesh mesh = build_mesh(TriangleSoup{a, b, c, a, e, d});
  for (const Vec3f& normal : mesh.normals) EXPECT_GT(std::fabs(normal.z), 0.99f);
}

TEST(Normals, AreZeroWhereThereIsNoArea) {
  const Mesh mesh = build_mesh(TriangleSoup{{0, 0, 0}, {0.1f, 0.1f, 0.1f}, {0.2f, 0.2f, 0.2f}});
  ASSERT_EQ(mesh.topology->triangles.size(), 1u);
  EXPECT_EQ(face_normal(mesh, 0), Vec3d{});
  for (const Vec3f& normal : mesh.normals) EXPECT_EQ(normal, Vec3f{});
}

TEST(Normals, OfThinTrianglesAreStillExact) {
  const Mesh mesh = build_mesh(TriangleSoup{{0, 0, 0}, {1000, 0, 0}, {500, 1e-6f, 0}});
  EXPECT_EQ(face_normal(mesh, 0), (Vec3d{0, 0, 1}));
}

TEST(Normals, HaveLengthOneAtAnyScale) {
  for (const float scale : {1e-30f, 1e-6f, 1.0f, 1e6f, 1e30f}) {
    const Mesh mesh = build_mesh(shapes::moved(shapes::sphere(1, 6), scale, {}));
    for (const Vec3f& normal : mesh.normals) EXPECT_NEAR(length(normal), 1, 2 * kRounding);
    for (std::uint32_t t = 0; t < mesh.topology->triangles.size(); ++t)
      EXPECT_NEAR(length(face_normal(mesh, t)), 1, 2 * kRounding);
  }
}

}  // namespace
}  // namespace ode_ext
