// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "shapes.h"
#include "support/validate_bvh.h"

namespace ode_ext {
namespace {

void expect_whole(const Mesh& mesh) {
  EXPECT_TRUE(mesh.finite);
  EXPECT_EQ(mesh.normals.size(), mesh.vertices.size());
  EXPECT_EQ(mesh.exits.size(), mesh.vertices.size());
  EXPECT_EQ(mesh.topology->source_triangle.size(), mesh.topology->triangles.size());
  for (std::uint32_t t = 0; t < mesh.topology->triangles.size(); ++t) {
    const double norm = length(face_normal(mesh, t));
    EXPECT_TRUE(norm == 0 || std::abs(norm - 1) < 1e-6) << norm;
  }
  EXPECT_EQ(test::validate_bvh(build_bvh(mesh.vertices, mesh.topology->triangles), mesh.vertices,
                               mesh.topology->triangles),
            "");
}

bool is_empty(const Mesh& mesh) {
  return mesh.vertices.empty() && mesh.normals.empty() && mesh.exits.empty() &&
         mesh.topology->triangles.empty() && mesh.topology->source_triangle.empty() &&
         mesh.topology->meshlets.triangles.empty() && mesh.topology->chunks.empty() &&
         mesh.box.lo == Vec3f{} && mesh.box.hi == Vec3f{} && mesh.radius == 0 &&
         mesh.mean_edge == 0 && !mesh.closed() && !mesh.topology->inverted &&
         !mesh.topology->reoriented;
}

TEST(BuildMesh, RefusesCoordinatesThatAreNotFinite) {
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), kEndless, -kEndless}) {
    for (const std::size_t at : {0u, 17u, 107u}) {
      TriangleSoup soup = shapes::cube();
      soup[at / 3][at % 3] = bad;
      const Mesh mesh = build_mesh(soup);
      EXPECT_FALSE(mesh.finite);
      EXPECT_TRUE(is_empty(mesh));
      EXPECT_EQ(mesh.content_hash, hash_soup(soup.data(), soup.size()));
    }
  }
}

TEST(BuildMesh, TakesAnEmptySoup) {
  const Mesh mesh = build_mesh({});
  EXPECT_TRUE(mesh.finite);
  EXPECT_TRUE(is_empty(mesh));
}

TEST(BuildMesh, TakesASingleTriangle) {
  const Mesh mesh = build_mesh(TriangleSoup{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}});
  expect_whole(mesh);
  EXPECT_FALSE(mesh.closed());
  EXPECT_EQ(mesh.mean_edge, 4);
  EXPECT_EQ(mesh.radius, 2.5f);
  EXPECT_EQ(mesh.exits, (std::vector<float>{4, 4, 4}));
  for (const Vec3f& normal : mesh.normals) EXPECT_EQ(normal, (Vec3f{0, 0, 1}));
}

TEST(BuildMesh, TakesAMeshOfCollapsedTriangles) {
  const Mesh mesh = build_mesh(TriangleSoup(30, Vec3f{1, 2, 3}));
  EXPECT_TRUE(mesh.finite);
  EXPECT_TRUE(is_empty(mesh));
}

TEST(BuildMesh, TakesAMeshOfSlivers) {
  TriangleSoup soup;
  for (int i = 0; i < 100; ++i) {
    const auto x = static_cast<float>(i);
    shapes::append(soup, {x, 0, 0}, {x + 1, 0, 0}, {x + 5, 0, 0});
  }
  const Mesh mesh = build_mesh(soup);
  expect_whole(mesh);
  EXPECT_EQ(mesh.topology->triangles.size(), 100u);
  for (const Vec3f& normal : mesh.normals) EXPECT_EQ(normal, Vec3f{});
  for (const float exit : mesh.exits) EXPECT_EQ(exit, 0);
}

TEST(BuildMesh, KnowsTheProgramsNumbersOfTheTriangles) {
  const TriangleSoup soup = shapes::sphere(1, 10);
  const Mesh mesh = build_mesh(soup);
  expect_whole(mesh);
  EXPECT_EQ(mesh.topology->triangles.size(),
            soup.size() / 3 - 2 * 20);  // the poles' collapsed ones
  const std::set<std::uint32_t> numbers(mesh.topology->source_triangle.begin(),
                                        mesh.topology->source_triangle.end());
  EXPECT_EQ(numbers.size(), mesh.topology->triangles.size());
  for (std::size_t i = 0; i < mesh.topology->triangles.size(); ++i) {
    EXPECT_TRUE(shapes::is_triangle_of(soup, mesh.topology->source_triangle[i], mesh,
                                       mesh.topology->triangles[i]));
  }
}

TEST(BuildMesh, MeasuresACube) {
  const Mesh mesh = build_mesh(shapes::box({1, 2, 3}, {3, 4, 5}));
  expect_whole(mesh);
  EXPECT_EQ(mesh.box.lo, (Vec3f{-1, -1, -1}));
  EXPECT_EQ(mesh.box.hi, (Vec3f{1, 1, 1}));
  EXPECT_EQ(box_as_given(mesh).lo, (Vec3f{1, 2, 3}));
  EXPECT_EQ(box_as_given(mesh).hi, (Vec3f{3, 4, 5}));
  EXPECT_GE(mesh.radius, std::sqrt(3.0));  // rounded up
  EXPECT_LT(mesh.radius, std::sqrt(3.0) * (1 + 0x1p-23));
  EXPECT_FLOAT_EQ(mesh.mean_edge, (2 + 2 + std::sqrt(8.0f)) / 3);
}

TEST(BuildMesh, DoesNotDependOnTheOrderOfTheTriangles) {
  for (const TriangleSoup& soup :
       {shapes::torus(1, 0.3, 16), shapes::random_soup(300, 41), shapes::sheet(10)}) {
    std::vector<std::size_t> order(soup.size() / 3);
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::shuffle(order.begin(), order.end(), std::mt19937(42));
    TriangleSoup shuffled;
    for (const std::size_t i : order) {
      shapes::append(shuffled, soup[3 * i + 2], soup[3 * i], soup[3 * i + 1]);
    }
    const Mesh one = build_mesh(soup, {.open_thickness = 0.25f}),
               two = build_mesh(shuffled, {.open_thickness = 0.25f});
    EXPECT_EQ(one.vertices, two.vertices);
    EXPECT_EQ(one.normals, two.normals);
    EXPECT_EQ(one.exits, two.exits);
    EXPECT_EQ(one.closed(), two.closed());
    EXPECT_EQ(one.radius, two.radius);
    EXPECT_EQ(one.topology->facets, two.topology->facets);
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      EXPECT_EQ(order[two.topology->source_triangle[i]], one.topology->source_triangle[i]);
      EXPECT_EQ(face_normal(one, i), face_normal(two, i));
    }
  }
}

TEST(BuildMesh, ScalesWithTheMesh) {
  const Mesh unit = build_mesh(shapes::torus(1, 0.3, 16));
  for (const float scale : {0x1p-20f, 0x1p20f}) {  // powers of two, so that nothing is rounded
    const Mesh mesh = build_mesh(shapes::moved(shapes::torus(1, 0.3, 16), scale, {}));
    expect_whole(mesh);
    EXPECT_TRUE(mesh.closed());
    EXPECT_EQ(mesh.normals, unit.normals);
    EXPECT_EQ(mesh.topology->triangles, unit.topology->triangles);
    EXPECT_EQ(mesh.radius, scale * unit.radius);
    for (std::size_t i = 0; i < unit.exits.size(); ++i) {
      EXPECT_EQ(mesh.exits[i], scale * unit.exits[i]);
    }
  }
}

TEST(BuildMesh, TakesAMeshFarFromItsOrigin) {
  const Vec3f far{1e6f, 2e6f, -1e6f};
  const Mesh mesh = build_mesh(shapes::moved(shapes::box({0, 0, 0}, {8, 8, 8}, 2), 1, far));
  expect_whole(mesh);
  EXPECT_TRUE(mesh.closed());
  EXPECT_FALSE(mesh.topology->inverted);
  int corners = 0;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Vec3f from_middle = mesh.vertices[i] + mesh.origin - far - Vec3f{4, 4, 4};
    if (length(from_middle) < 6.9f) continue;  // corners are at 4 * sqrt(3)
    EXPECT_NEAR(mesh.exits[i], 8 * std::sqrt(3.0f), 1e-5f);
    ++corners;
  }
  EXPECT_EQ(corners, 8);
}

TEST(BuildMesh, TakesTheLargestAndSmallestFloats) {
  constexpr float kLargest = std::numeric_limits<float>::max();
  constexpr float kSmallest = std::numeric_limits<float>::denorm_min();
  for (const float size : {kLargest, kSmallest}) {
    const Mesh mesh = build_mesh(shapes::moved(shapes::box({-1, -1, -1}, {1, 1, 1}), size, {}));
    expect_whole(mesh);
    EXPECT_TRUE(mesh.closed());
    EXPECT_EQ(mesh.vertices.size(), 8u);
    for (const Vec3f& normal : mesh.normals) EXPECT_NEAR(length(normal), 1, 1e-6f);
  }
}

}  // namespace
}  // namespace ode_ext
