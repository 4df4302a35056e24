// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "mesh/ray_cast.h"

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
    std::array<Vec3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = Vec3d(vertices[triangles[t][k]]);
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
    open.assign(1, seed.triangle);
    while (!open.empty()) {
      const std::uint32_t triangle = open.back();
      open.pop_back();
      for (const std::uint32_t next : neighbours[triangle]) {
        if (next == kNone || facet[next] != kNone || face_normals[next] == Vec3f{}) continue;
        if (!(length(Vec3d(face_normals[next]) - Vec3d(normal)) < kFlat)) continue;
        facet[next] = seed.triangle;
        open.push_back(next);
      }
    }
  }
  return facet;
}

}  // namespace ode_ext
