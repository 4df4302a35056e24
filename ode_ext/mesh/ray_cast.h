// SPDX-License-Identifier: BSD-3-Clause
// Rays against a mesh on the host, in double precision: for what is computed once per mesh.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "mesh/bvh.h"
#include "mesh/vec.h"

namespace ode_ext {

struct Ray {
  Vec3d origin;     // [m]
  Vec3d direction;  // unit, or t is in multiples of its length
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
  std::uint32_t excluded_vertex = kNone;  // triangles with this corner are passed through
  double near = 0;  // within so much of t two faces are met at once: RayHit::both
};

struct RayHit {
  double t = std::numeric_limits<double>::infinity();  // [m] if the direction is a unit vector
  std::uint32_t triangle = kNone;                      // kNone: nothing was hit
  bool back = false;  // a back face: the direction is that of the triangle's normal
  bool both = false;  // and at once a face that looks the other way
};

// The nearest hit within [t_min, t_max], of two at the same t that of the lower triangle index.
// Triangles are two-sided and include their edges, and neighbours agree about the edge they share,
// so that no ray slips between them. Triangles without area, or parallel to the ray, are never hit.
RayHit cast_ray(const Ray& ray, const Bvh& bvh, const std::vector<Vec3f>& vertices,
                const std::vector<Triangle>& triangles);

}  // namespace ode_ext
