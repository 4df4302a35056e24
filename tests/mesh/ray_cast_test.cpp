// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ray_cast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "mesh/weld.h"
#include "shapes.h"

namespace ode_ext {
namespace {

Vec3d random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random), y = normal(random), z = normal(random);
  return (1 / std::sqrt(x * x + y * y + z * z)) * Vec3d{x, y, z};
}

// Moeller and Trumbore's test of every triangle: nothing shared with the code under test.
RayHit brute_force(const Ray& ray, const WeldedMesh& mesh) {
  RayHit nearest;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& triangle = mesh.triangles[i];
    if (std::find(triangle.begin(), triangle.end(), ray.excluded_vertex) != triangle.end())
      continue;
    const Vec3d a(mesh.vertices[triangle[0]]);
    const Vec3d ab = Vec3d(mesh.vertices[triangle[1]]) - a;
    const Vec3d ac = Vec3d(mesh.vertices[triangle[2]]) - a;
    const double det = dot(ab, cross(ray.direction, ac));
    const Vec3d ao = ray.origin - a;
    const double u = dot(ao, cross(ray.direction, ac)) / det;
    const double v = dot(ray.direction, cross(ao, ab)) / det;
    const double t = dot(ac, cross(ao, ab)) / det;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && t >= ray.t_min && t <= ray.t_max)) continue;
    if (t < nearest.t) nearest = {t, i, dot(ray.direction, cross(ab, ac)) > 0};
  }
  return nearest;
}

TEST(RayCast, FindsWhatTryingEveryTriangleFinds) {
  const WeldedMesh mesh = weld(shapes::random_soup(300, 11));
  const Bvh bvh = build_bvh(mesh.vertices, mesh.triangles);
  std::mt19937 random(12);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = place(random), y = place(random), z = place(random);
    Ray ray{{x, y, z}, random_direction(random)};
    if (i % 3 == 1) ray.t_min = 0.5;
    if (i % 3 == 2) ray.t_max = 0.5;
    if (i % 2 == 1) {
      ray.excluded_vertex = static_cast<std::uint32_t>(random() % mesh.vertices.size());
      ray.origin = Vec3d(mesh.vertices[ray.excluded_vertex]);
    }
    const RayHit expected = brute_force(ray, mesh);
    const RayHit hit = cast_ray(ray, bvh, mesh.vertices, mesh.triangles);
    ASSERT_EQ(hit.triangle, expected.triangle) << i;
    if (expected.triangle == kNone) continue;
    EXPECT_NEAR(hit.t, expected.t, 1e-12);
    EXPECT_EQ(hit.back, expected.back);
    ++hits;
  }
  EXPECT_GT(hits, 5000);
}

TEST(RayCast, LetsNoRaySlipThroughEdgesAndVertices) {
  const WeldedMesh mesh = weld(shapes::moved(shapes::sphere(1, 24), 1, {0.3f, -0.2f, 0.7f}));
  const Bvh bvh = build_bvh(mesh.vertices, mesh.triangles);
  std::mt19937 random(13);
  std::uniform_real_distribution<double> place(-0.4, 0.4), part(0, 1);
  for (const Triangle& triangle : mesh.triangles) {
    const double x = place(random), y = place(random), z = place(random), s = part(random);
    const Vec3d origin = Vec3d{0.3, -0.2, 0.7} + Vec3d{x, y, z};
    const Vec3d a(mesh.vertices[triangle[0]]), b(mesh.vertices[triangle[1]]);
    for (const Vec3d& target : {a, b, 0.5 * (a + b), s * a + (1 - s) * b}) {
      const RayHit hit = cast_ray({origin, target - origin}, bvh, mesh.vertices, mesh.triangles);
      ASSERT_NE(hit.triangle, kNone);
      EXPECT_NEAR(hit.t, 1, 1e-12);
      EXPECT_TRUE(hit.back);
    }
  }
}

TEST(RayCast, HitsAlongAxesThroughCornersOfBoxes) {
  // Directions with zeros make the slabs infinite; origins on the planes make them 0 * infinity.
  const WeldedMesh mesh = weld(shapes::box({0, 0, 0}, {1, 1, 1}, 4));
  const Bvh bvh = build_bvh(mesh.vertices, mesh.triangles);
  for (const double x : {0.0, 0.25, 0.5, 1.0}) {
    for (const double y : {0.0, 0.125, 0.75, 1.0}) {
      for (const double zero : {0.0, -0.0}) {
        const RayHit down =
            cast_ray({{x, y, 3}, {zero, zero, -1}}, bvh, mesh.vertices, mesh.triangles);
        EXPECT_EQ(down.t, 2);
        EXPECT_FALSE(down.back);
        const RayHit up =
            cast_ray({{0.5, x, y}, {1, zero, zero}}, bvh, mesh.vertices, mesh.triangles);
        EXPECT_EQ(up.t, 0.5);
        EXPECT_TRUE(up.back);
      }
    }
  }
}

TEST(RayCast, TakesTheLowerIndexOfTwoAtTheSameDistance) {
  const TriangleSoup one{{-1, -1, 2}, {1, -1, 2}, {0, 1, 2}};
  TriangleSoup many;
  for (int i = 0; i < 20; ++i) many = shapes::joined(many, one);
  const WeldedMesh mesh = weld(many);
  const Bvh bvh = build_bvh(mesh.vertices, mesh.triangles);
  EXPECT_EQ(cast_ray({{0, 0, 0}, {0, 0, 1}}, bvh, mesh.vertices, mesh.triangles).triangle, 0u);
}

TEST(RayCast, TellsFrontFromBackInEveryDirection) {
  const WeldedMesh mesh = weld(shapes::sphere(1, 8));
  const Bvh bvh = build_bvh(mesh.vertices, mesh.triangles);
  std::mt19937 random(14);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d direction = random_direction(random);
    const Vec3d outside = -2.0 * direction;
    EXPECT_FALSE(cast_ray({outside, direction}, bvh, mesh.vertices, mesh.triangles).back);
    EXPECT_TRUE(cast_ray({{0, 0, 0}, direction}, bvh, mesh.vertices, mesh.triangles).back);
  }
}

TEST(RayCast, NeverHitsTrianglesWithoutArea) {
  const WeldedMesh mesh = weld(TriangleSoup{{0, 0, 1}, {1, 0, 1}, {2, 0, 1}});
  const Bvh bvh = build_bvh(mesh.vertices, mesh.triangles);
  for (const double x : {0.0, 0.5, 1.0, 1.5}) {
    EXPECT_EQ(cast_ray({{x, 0, 0}, {0, 0, 1}}, bvh, mesh.vertices, mesh.triangles).triangle, kNone);
  }
}

TEST(RayCast, FindsNothingInAMeshWithoutTriangles) {
  EXPECT_EQ(cast_ray({{0, 0, 0}, {0, 0, 1}}, {}, {}, {}).triangle, kNone);
}

}  // namespace
}  // namespace ode_ext
