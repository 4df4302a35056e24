// SPDX-License-Identifier: BSD-3-Clause
#include "support/convex_makers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "support/fcl_oracle.h"

namespace ode_ext::test {
namespace {

double convex_volume(const TestMesh& mesh) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    sum += dot(mesh.corner(t, 0), cross(mesh.corner(t, 1), mesh.corner(t, 2))) / 6;
  }
  return sum;
}

// Every directed edge once, and its reverse; and as many of all as Euler says.
bool is_a_closed_surface_like_a_ball(const TestMesh& mesh) {
  std::map<std::pair<unsigned, unsigned>, int> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    ++edges[{mesh.indices[i], mesh.indices[i % 3 == 2 ? i - 2 : i + 1]}];
  }
  for (const auto& [edge, count] : edges) {
    if (count != 1 || !edges.contains({edge.second, edge.first})) return false;
  }
  return mesh.vertex_count() - static_cast<int>(edges.size()) / 2 + mesh.triangle_count() == 2;
}

// No vertex above the plane of any triangle, but for float rounding of vertices about 1 from 0.
bool is_convex(const TestMesh& mesh) {
  for (std::size_t t = 0; t < mesh.indices.size() / 3; ++t) {
    const Point a = mesh.corner(t, 0);
    const Point normal = unit(cross(mesh.corner(t, 1) - a, mesh.corner(t, 2) - a));
    for (std::size_t i = 0; i < mesh.vertices.size() / 3; ++i) {
      if (dot(normal, mesh.vertex(i) - a) > 1e-6) return false;
    }
  }
  return true;
}

TEST(ConvexMakers, MakeClosedConvexSolidsOfTheRightVolume) {
  const double polygon = 0.5 * 12 * std::sin(std::numbers::pi / 6);  // 12 sides, radius 1
  struct Solid {
    std::string name;
    TestMesh mesh;
    double volume, tolerance;
  };
  const Solid solids[] = {
      {"octahedron", make_octahedron(1), 4.0 / 3, 1e-6},
      {"cylinder", make_cylinder(1, 2, 12), 2 * polygon, 1e-5},
      {"cone", make_cone(1, 1.5, 12), 0.5 * polygon, 1e-5},
      // Inscribed; 1280 triangles lose 1 %.
      {"ellipsoid", make_ellipsoid({1, 0.5, 0.8}, 3), 0.4 * 4 * std::numbers::pi / 3, 0.02},
  };
  for (const Solid& solid : solids) {
    EXPECT_TRUE(is_a_closed_surface_like_a_ball(solid.mesh)) << solid.name;
    EXPECT_TRUE(is_convex(solid.mesh)) << solid.name;
    EXPECT_NEAR(convex_volume(solid.mesh), solid.volume, solid.tolerance) << solid.name;
  }
}

TEST(ConvexMakers, MakeTheHullOfRandomPointsAndLeaveOutWhatIsInside) {
  Random random(1);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Point> points;
    for (int i = 0; i < 20; ++i) points.push_back(random.uniform(0.1, 1) * random.direction());
    const TestMesh hull = make_hull(points);
    EXPECT_TRUE(is_a_closed_surface_like_a_ball(hull));
    EXPECT_TRUE(is_convex(hull));
    EXPECT_LT(hull.vertex_count(), 20);
    for (const Point& p : points) {
      bool is_vertex = false;
      for (std::size_t i = 0; i < hull.vertices.size() / 3; ++i)
        is_vertex = is_vertex || distance(hull.vertex(i), p) < 1e-6;
      EXPECT_TRUE(is_vertex || winding_number(hull, p) > 0.5);
    }
  }
}

TEST(ConvexMakers, GiveTheSameRandomHullForTheSameNumbers) {
  Random one(7), two(7);
  EXPECT_EQ(make_random_hull(one, 20, 0.5).vertices, make_random_hull(two, 20, 0.5).vertices);
}

}  // namespace
}  // namespace ode_ext::test
