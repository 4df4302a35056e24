// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/surface.h"

#include <cmath>

#include "geometry/triangle_tree.h"

namespace falling_objects {

using ode_ext::oracle::ClosestPoint;
using ode_ext::oracle::Triangle;
using ode_ext::oracle::Vector;

namespace {

// Closer than this [m] the direction to the surface is rounding: meshes come in floats.
constexpr double kOnSurface = 1e-7;

}  // namespace

Surface::Surface(const TriangleMesh& mesh) : corners_(mesh.indices), first_(mesh.vertex_count()) {
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const Point p = mesh.vertex(i);
    vertices_.push_back({p[0], p[1], p[2]});
  }
  for (std::size_t i = 0; i < corners_.size(); i += 3) {
    const Vector &a = vertices_[corners_[i]], &b = vertices_[corners_[i + 1]],
                 &c = vertices_[corners_[i + 2]];
    normals_.push_back(unit(cross(b - a, c - a)));
  }
  std::vector<std::size_t> count(mesh.vertex_count());
  for (const unsigned v : corners_) ++count[v];
  std::size_t sum = 0;
  for (std::size_t v = 0; v < count.size(); ++v) {
    first_[v] = sum;
    sum += count[v];
  }
  first_.push_back(sum);
  around_.resize(sum);
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const unsigned v = corners_[i];
    around_[first_[v + 1] - count[v]--] = i / 3;
  }
}

// Where the closest place is on an edge or a corner, several triangles have it: the side of p is
// told by the one that faces p most.
Surface::Place Surface::closest_from(std::size_t triangle, Vector p) const {
  const auto corners = [&](std::size_t t) {
    return Triangle{vertices_[corners_[3 * t]], vertices_[corners_[3 * t + 1]],
                    vertices_[corners_[3 * t + 2]]};
  };
  ClosestPoint best = closest_on_triangle(corners(triangle), p);
  double facing = dot(normals_[triangle], p - best.point);
  for (bool moved = true; moved;) {
    moved = false;
    const std::size_t from = triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      const unsigned v = corners_[3 * from + k];
      for (std::size_t i = first_[v]; i < first_[v + 1]; ++i) {
        const std::size_t candidate = around_[i];
        const ClosestPoint next = closest_on_triangle(corners(candidate), p);
        const double closer = best.squared_distance - next.squared_distance;
        const double next_facing = dot(normals_[candidate], p - next.point);
        // Rounding makes equal distances differ by some 1e-16 of themselves.
        const double same = 1e-12 * best.squared_distance;
        if (closer < -same ||
            (closer <= same && std::abs(next_facing) <= 1.000001 * std::abs(facing)))
          continue;
        best = next;
        facing = next_facing;
        triangle = candidate;
        moved = true;
      }
    }
  }
  const double distance = std::copysign(std::sqrt(best.squared_distance), facing);
  const bool on_surface = std::abs(distance) < kOnSurface;
  return {best.point, on_surface ? normals_[triangle] : (1 / distance) * (p - best.point), distance,
          triangle};
}

}  // namespace falling_objects
