// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/normals.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace ode_ext {
namespace {

// The cross product of two rounded differences is off by at most 8 roundings (2 for the factors,
// 1 for the products, 1 for their difference, times sqrt(3) for three components) of the product
// of the lengths. A smaller one is noise, and the area zero.
constexpr double kZeroArea = 8 * 0x1p-53;

// The program's coordinates are floats, so each unit normal is uncertain by about 2^-24 even where
// its triangle is well shaped. A sum 16 times as long, 2^-20 ~ 1e-6 of the weights, still has a
// direction; below that it is made of rounding.
constexpr double kVanishing = 0x1p-20;

// Sums are kept in fixed point, since only integers add up to the same in every order. Terms are
// at most pi, so 2^25 of them fit into 63 bits; the resolution of 2^-36 is far below a float's.
constexpr double kFixedPoint = 0x1p36;

struct VertexSum {
  std::int64_t x = 0, y = 0, z = 0, weight = 0;
  double largest_area = 0;
  Vec3d largest_normal{};
};

struct FaceNormal {
  Vec3d unit{};
  double area = 0;  // twice the area [m^2]
};

FaceNormal measure(Vec3f apex, Vec3f next, Vec3f last) {
  const Vec3d a = Vec3d(next) - Vec3d(apex);
  const Vec3d b = Vec3d(last) - Vec3d(apex);
  const Vec3d normal = cross(a, b);
  const double area = length(normal);
  if (area <= kZeroArea * length(a) * length(b)) return {};
  return {(1 / area) * normal, area};
}

// Always starts at the lowest corner, so that only the winding matters.
FaceNormal measure(const std::vector<Vec3f>& vertices, const Triangle& triangle) {
  const auto lowest = static_cast<std::size_t>(std::min_element(triangle.begin(), triangle.end()) -
                                               triangle.begin());
  return measure(vertices[triangle[lowest]], vertices[triangle[(lowest + 1) % 3]],
                 vertices[triangle[(lowest + 2) % 3]]);
}

// Accurate for all angles, unlike the arc cosine; the same for either order of a and b.
double angle_between(Vec3d a, Vec3d b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

std::int64_t fixed(double value) { return std::llround(kFixedPoint * value); }

void add(VertexSum& sum, const FaceNormal& face, double angle) {
  sum.x += fixed(angle * face.unit.x);
  sum.y += fixed(angle * face.unit.y);
  sum.z += fixed(angle * face.unit.z);
  sum.weight += fixed(angle);
  const auto rank = [](double area, const Vec3d& n) { return std::tuple(area, n.x, n.y, n.z); };
  if (rank(face.area, face.unit) > rank(sum.largest_area, sum.largest_normal)) {
    sum.largest_area = face.area;
    sum.largest_normal = face.unit;
  }
}

Vec3f vertex_normal(const VertexSum& sum) {
  const Vec3d normal{static_cast<double>(sum.x), static_cast<double>(sum.y),
                     static_cast<double>(sum.z)};
  const double norm = length(normal);
  if (norm <= kVanishing * static_cast<double>(sum.weight)) return Vec3f(sum.largest_normal);
  return Vec3f((1 / norm) * normal);
}

}  // namespace

Vec3d face_normal(Vec3f a, Vec3f b, Vec3f c) { return measure(a, b, c).unit; }

Vec3f face_normal(const std::vector<Vec3f>& vertices, const Triangle& triangle) {
  return Vec3f(measure(vertices, triangle).unit);
}

Normals compute_normals(const std::vector<Vec3f>& vertices,
                        const std::vector<Triangle>& triangles) {
  Normals normals;
  normals.faces.reserve(triangles.size());
  std::vector<VertexSum> sums(vertices.size());
  for (const Triangle& triangle : triangles) {
    const FaceNormal face = measure(vertices, triangle);
    normals.faces.push_back(Vec3f(face.unit));
    if (face.area == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d corner(vertices[triangle[k]]);
      const Vec3d next = Vec3d(vertices[triangle[(k + 1) % 3]]) - corner;
      const Vec3d previous = Vec3d(vertices[triangle[(k + 2) % 3]]) - corner;
      add(sums[triangle[k]], face, angle_between(next, previous));
    }
  }
  normals.vertices.reserve(vertices.size());
  for (const VertexSum& sum : sums) normals.vertices.push_back(vertex_normal(sum));
  return normals;
}

}  // namespace ode_ext
