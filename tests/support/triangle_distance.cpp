// SPDX-License-Identifier: BSD-3-Clause
#include "support/triangle_distance.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace ode_ext {
namespace {

// Of the sine squared. The normal of a triangle with a smaller angle is made of rounding (8 * 2^-53
// of its sides, normals.cpp); all of it is within 2^-50 of one of its sides.
constexpr double kNoArea = 0x1p-100;

// Of the sine squared, for two segments. The place where the lines are nearest is known to
// 2^-52 / sine^2 of the length, which shifts the distance by that times the sine: 2^-32 at most.
// Segments closer to parallel are 2^-20 of the length apart from being so.
constexpr double kParallel = 0x1p-40;

double clamped(double part) { return std::clamp(part, 0.0, 1.0); }

double squared_length(Vec3d a) { return dot(a, a); }

// The part of the segment at which `point` is nearest to it.
double nearest_part(Vec3d point, Vec3d start, Vec3d along) {
  const double squared = squared_length(along);
  return squared > 0 ? clamped(dot(point - start, along) / squared) : 0;
}

Vec3d edge_of(const Corners& triangle, std::size_t k) {
  return triangle[(k + 1) % 3] - triangle[k];
}

}  // namespace

double squared_distance(Vec3d point, const Segment& segment) {
  const Vec3d along = segment[1] - segment[0];
  return squared_length(segment[0] + nearest_part(point, segment[0], along) * along - point);
}

double squared_distance(Vec3d point, const Corners& triangle) {
  const Vec3d first = edge_of(triangle, 0), last = edge_of(triangle, 2);
  const Vec3d normal = cross(last, first);
  const double area = squared_length(normal);
  const bool flat = area <= kNoArea * squared_length(first) * squared_length(last);

  // From outside, the nearest place is on an edge that has the point on its outer side.
  bool inside = !flat;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3d from = point - triangle[k];
    if (!flat && dot(cross(edge_of(triangle, k), normal), from) <= 0) continue;
    inside = false;
    const Segment edge{triangle[k], triangle[(k + 1) % 3]};
    nearest = std::min(nearest, squared_distance(point, edge));
  }
  if (!inside) return nearest;
  const double height = dot(normal, point - triangle[0]);
  return height * height / area;
}

double squared_distance(const Segment& a, const Segment& b) {
  const Vec3d along_a = a[1] - a[0], along_b = b[1] - b[0], between = a[0] - b[0];
  const double aa = squared_length(along_a), bb = squared_length(along_b);
  const double ab = dot(along_a, along_b);
  const double determinant = aa * bb - ab * ab;
  double part_a = 0;
  if (determinant > kParallel * aa * bb) {
    part_a = clamped((ab * dot(along_b, between) - bb * dot(along_a, between)) / determinant);
  }
  // Whatever the one point, the other is the nearest to it; twice, as an end may have cut the first
  // answer off.
  const double part_b = nearest_part(a[0] + part_a * along_a, b[0], along_b);
  const Vec3d on_b = b[0] + part_b * along_b;
  return squared_distance(on_b, a);
}

bool crosses(const Segment& segment, const Corners& triangle) {
  const Vec3d normal = cross(edge_of(triangle, 0), triangle[2] - triangle[0]);
  const double start = dot(normal, segment[0] - triangle[0]);
  const double end = dot(normal, segment[1] - triangle[0]);
  if (!((start < 0 && end > 0) || (start > 0 && end < 0))) return false;
  const Vec3d place = segment[0] + (start / (start - end)) * (segment[1] - segment[0]);
  for (std::size_t k = 0; k < 3; ++k) {
    if (dot(cross(normal, edge_of(triangle, k)), place - triangle[k]) < 0) return false;
  }
  return true;
}

}  // namespace ode_ext
