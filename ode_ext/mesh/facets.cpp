// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "mesh/corners.h"

namespace ode_ext {
namespace {

// An edge of less than this makes no contact (edges.h). What such edges can hide: a crown of facets
// rises less than a quarter of its width times the angle, 1/2300 of the width, above the plane
// through its border.
constexpr double kFlat = 0.1 * 3.14159265358979 / 180;

// By place, so that the numbering of the triangles does not matter.
struct Seed {
  double area;
  Vec3d middle;
  std::uint32_t triangle;
};

bool comes_first(const Seed& a, const Seed& b) {
  if (a.area != b.area) return a.area > b.area;
  return std::tie(a.middle.x, a.middle.y, a.middle.z, a.triangle) <
         std::tie(b.middle.x, b.middle.y, b.middle.z, b.triangle);
}

std::vector<Seed> seeds(const std::vector<Vec3f>& vertices,
                        const std::vector<Triangle>& triangles) {
  std::vector<Seed> result;
  result.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    Corners corners = corners_of(vertices, triangles[t]);
    // From whichever corner they are listed: rounding is to be the same.
    std::sort(corners.begin(), corners.end(), [](const Vec3d& a, const Vec3d& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    });
    const auto& [a, b, c] = corners;
    result.push_back({length(cross(b - a, c - a)), a + b + c, t});
  }
  std::sort(result.begin(), result.end(), comes_first);
  return result;
}

// The plane of a triangle, and how far from it a point of it may be. Coordinates are taken to be as
// large as its longest side: where a mesh was modelled, and what else is in it, is to decide
// nothing.
class Plane {
 public:
  Plane(const Corners& corners, Vec3f normal) : corners_(corners), normal_(normal) {
    rounding_ = kCornerRounding * longest_side(corners);
    turned_ = std::min(rounding_ / height(corners), kFlat);
  }
  // Whether a triangle lies in it, and faces as it does but for what rounding turns either by.
  bool holds(const Corners& triangle, Vec3f normal) const {
    return dot(Vec3d(normal), normal_) > 0 &&
           length(Vec3d(normal) - normal_) <= kFlat + rounding_ / height(triangle) &&
           std::all_of(triangle.begin(), triangle.end(),
                       [&](const Vec3d& corner) { return holds(corner); });
  }

 private:
  bool holds(const Vec3d& point) const {
    double nearest = INFINITY;
    for (const Vec3d& corner : corners_) nearest = std::min(nearest, length(point - corner));
    return std::abs(dot(normal_, point - corners_[0])) <= rounding_ + turned_ * nearest;
  }

  Corners corners_;
  Vec3d normal_;
  double rounding_;  // [m]
  double turned_;    // [rad]
};

}  // namespace

std::vector<std::uint32_t> facets(const std::vector<Vec3f>& vertices,
                                  const std::vector<Triangle>& triangles,
                                  const std::vector<Vec3f>& face_normals,
                                  const std::vector<Neighbours>& neighbours) {
  std::vector<std::uint32_t> facet(triangles.size(), kNone);
  std::vector<std::uint32_t> open;
  for (const Seed& seed : seeds(vertices, triangles)) {
    if (facet[seed.triangle] != kNone) continue;
    facet[seed.triangle] = seed.triangle;
    const Vec3f normal = face_normals[seed.triangle];
    if (normal == Vec3f{}) continue;
    const Plane plane(corners_of(vertices, triangles[seed.triangle]), normal);
    const auto belongs = [&](std::uint32_t t) {
      return length(Vec3d(face_normals[t]) - Vec3d(normal)) < kFlat ||
             plane.holds(corners_of(vertices, triangles[t]), face_normals[t]);
    };
    open.assign(1, seed.triangle);
    while (!open.empty()) {
      const std::uint32_t triangle = open.back();
      open.pop_back();
      for (const std::uint32_t next : neighbours[triangle]) {
        if (next == kNone || facet[next] != kNone || face_normals[next] == Vec3f{}) continue;
        if (!belongs(next)) continue;
        facet[next] = seed.triangle;
        open.push_back(next);
      }
    }
  }
  return facet;
}

}  // namespace ode_ext
