// SPDX-License-Identifier: BSD-3-Clause
#include "support/convex_makers.h"

#include <cmath>
#include <numbers>
#include <optional>

namespace ode_ext::test {
namespace {

unsigned add_vertex(TestMesh& mesh, const Point& p) {
  for (const double c : p) mesh.vertices.push_back(static_cast<float>(c));
  return static_cast<unsigned>(mesh.vertex_count() - 1);
}

void add_triangle(TestMesh& mesh, unsigned a, unsigned b, unsigned c) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

// The side of the plane through three of the points on which all others are; none if they are on
// both.
std::optional<bool> side_of_the_others(const std::vector<Point>& points, std::size_t a,
                                       std::size_t b, std::size_t c) {
  const Point normal = cross(points[b] - points[a], points[c] - points[a]);
  std::optional<bool> above;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i == a || i == b || i == c) continue;
    const bool is_above = dot(normal, points[i] - points[a]) > 0;
    if (above && *above != is_above) return std::nullopt;
    above = is_above;
  }
  return above;
}

}  // namespace

TestMesh make_octahedron(double radius) {
  return make_hull({{radius, 0, 0},
                    {-radius, 0, 0},
                    {0, radius, 0},
                    {0, -radius, 0},
                    {0, 0, radius},
                    {0, 0, -radius}});
}

TestMesh make_cone(double radius, double height, int sides) {
  TestMesh mesh;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    add_vertex(mesh, {radius * std::cos(angle), radius * std::sin(angle), -height / 2});
  }
  const unsigned apex = add_vertex(mesh, {0, 0, height / 2});
  const auto n = static_cast<unsigned>(sides);
  for (unsigned i = 0; i < n; ++i) add_triangle(mesh, i, (i + 1) % n, apex);
  for (unsigned i = 1; i + 1 < n; ++i) add_triangle(mesh, 0, i + 1, i);
  return mesh;
}

TestMesh make_ellipsoid(const Point& radii, int subdivisions) {
  TestMesh mesh = make_icosphere(1, subdivisions);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    mesh.vertices[i] = static_cast<float>(mesh.vertices[i] * radii[i % 3]);
  return mesh;
}

TestMesh make_hull(const std::vector<Point>& points) {
  TestMesh mesh;
  std::vector<std::optional<unsigned>> index(points.size());
  const auto vertex = [&](std::size_t i) {
    if (!index[i]) index[i] = add_vertex(mesh, points[i]);
    return *index[i];
  };
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = a + 1; b < points.size(); ++b) {
      for (std::size_t c = b + 1; c < points.size(); ++c) {
        const auto above = side_of_the_others(points, a, b, c);
        if (!above) continue;
        add_triangle(mesh, vertex(a), vertex(*above ? c : b), vertex(*above ? b : c));
      }
    }
  }
  return mesh;
}

TestMesh make_random_hull(Random& random, int count, double radius) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double r = radius * random.uniform(0.6, 1);
    points.push_back(r * random.direction());
  }
  return make_hull(points);
}

}  // namespace ode_ext::test
