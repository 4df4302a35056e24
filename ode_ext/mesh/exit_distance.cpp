// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/exit_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/both.h"
#include "mesh/box.h"
#include "mesh/ray_cast.h"

namespace ode_ext {
namespace {

// A vertex may lie on a face it does not belong to (two parts glued together). That face is where
// the ray starts, not where it leaves, although rounding the coordinates to floats has moved both
// apart: by sqrt(3) * 2^-24 of the mesh's size each, so 2^-22 together.
constexpr double kOnSurface = 0x1p-22;

// Along a ray two walls so near one another are farther apart, the more so the flatter it meets
// them: so many times at less than 83 degrees.
constexpr double kAlongRay = 8;

// Each takes a ray; more are in the way in heaps of parts alone.
constexpr int kMostWalls = 16;

// Where a ray that starts inside leaves; infinity: it does not. Faces that it meets at once are one
// wall: two triangles at an edge, or where one part ends and the next begins. If there is nothing
// behind a wall, the ray leaves by it: at a corner of two parts it leaves both at once.
double exit_along(Ray ray, const Bvh& bvh, const std::vector<Vec3f>& vertices,
                  const std::vector<Triangle>& triangles) {
  int inside = 1;
  double last = std::numeric_limits<double>::infinity();
  for (int wall = 0; wall < kMostWalls; ++wall) {
    const RayHit hit = cast_ray(ray, bvh, vertices, triangles);
    if (hit.triangle == kNone) break;
    last = hit.both ? hit.t : std::numeric_limits<double>::infinity();
    if (!hit.both) inside += hit.back ? -1 : 1;
    if (inside == 0) return hit.t;
    ray.t_min = std::nextafter(hit.t + ray.near, std::numeric_limits<double>::infinity());
  }
  return last;
}

// A thread takes tens of microseconds to start, a ray one or more.
constexpr std::size_t kVerticesAThread = 4096;

}  // namespace

std::vector<float> exit_distances(const std::vector<Vec3f>& vertices,
                                  const std::vector<Vec3f>& normals,
                                  const std::vector<Triangle>& triangles, const Bvh& bvh,
                                  float thickness) {
  const double on_surface = kOnSurface * length(extent(box_of(vertices)));
  std::vector<float> exits(vertices.size(), thickness);
  const auto exit_of = [&](std::size_t i) {
    if (normals[i] == Vec3f{}) {
      exits[i] = 0;
      return;
    }
    Ray ray{Vec3d(vertices[i]), -Vec3d(normals[i])};
    ray.t_min = on_surface;
    ray.t_max = static_cast<double>(thickness);
    ray.excluded_vertex = static_cast<std::uint32_t>(i);
    ray.near = kAlongRay * on_surface;
    exits[i] = std::min(static_cast<float>(exit_along(ray, bvh, vertices, triangles)), thickness);
  };
  const auto exits_of = [&](auto self, std::size_t first, std::size_t last,
                            std::size_t threads) -> void {
    if (threads <= 1) {
      for (std::size_t i = first; i < last; ++i) exit_of(i);
      return;
    }
    const std::size_t half = threads / 2;
    const std::size_t middle = first + (last - first) * half / threads;
    do_both(
        threads, [&] { self(self, first, middle, half); },
        [&] { self(self, middle, last, threads - half); });
  };
  exits_of(exits_of, 0, vertices.size(), worthwhile_threads(vertices.size(), kVerticesAThread));
  return exits;
}

}  // namespace ode_ext
