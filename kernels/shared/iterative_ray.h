// SPDX-License-Identifier: BSD-3-Clause
// The iterative ray algorithm (GRAPP section 3, from Lehericey 2013): from the triangle that the
// line of this vertex met in the last step, walk across edges to the one that it meets now. Device
// only.
//
// A triangle on the line need not be the first. What is found counts only with a proof: a ball
// about the triangle's middle in which every triangle faces the ray's way (geometry/isolation.h).
// Through such a ball a line passes the surface once at most, since between two exits there is an
// entry. So if the vertex and its hit are both in it, nothing else lies between them.
#ifndef ODE_EXT_KERNELS_SHARED_ITERATIVE_RAY_H
#define ODE_EXT_KERNELS_SHARED_ITERATIVE_RAY_H

#include "shared/full_ray.h"

typedef struct {
  uint triangle;  // over all meshes; OX_NONE: the walk failed
  float t;        // [m] may be negative
  bool back;
  bool interior;  // the line passes its edges by more than rounding can move it
} ox_crossing;

static inline float2 ox_sheared(const ox_cast* cast, float3 corner) {
  const float3 p = corner - cast->origin;
  const float z = ox_axis(p, cast->kz);
  return (float2)(fma(-cast->sx, z, ox_axis(p, cast->kx)), fma(-cast->sy, z, ox_axis(p, cast->ky)));
}

// `area` is twice the area between the line and the edge from p to q: does it keep off by `margin`?
static inline bool ox_keeps_off(float area, float2 p, float2 q, float margin) {
  const float x = q.x - p.x;
  const float y = q.y - p.y;
  return area * area > margin * margin * (x * x + y * y);
}

static inline ox_crossing ox_walk(const ox_cast* cast, __global const ox_triangle* triangles,
                                  uint first, uint start, uint limit, float epsilon, uint* work) {
  ox_crossing crossing;
  crossing.triangle = OX_NONE;
  uint k = start;
  for (uint step = 0u; step <= limit; ++step) {
    *work += OX_WORK_TRIANGLE;
    __global const ox_triangle* triangle = triangles + first + k;
    const float3 corner_a = vload3(0, triangle->a);
    const float3 corner_b = vload3(0, triangle->b);
    const float3 corner_c = vload3(0, triangle->c);
    const float2 a = ox_sheared(cast, corner_a);
    const float2 b = ox_sheared(cast, corner_b);
    const float2 c = ox_sheared(cast, corner_c);
    const float u = ox_det2(c.x, b.y, c.y, b.x);
    const float v = ox_det2(a.x, c.y, a.y, c.x);
    const float w = ox_det2(b.x, a.y, b.y, a.x);
    const float determinant = u + v + w;
    if (determinant == 0.0f) return crossing;
    const float sign = determinant < 0.0f ? -1.0f : 1.0f;
    const float su = sign * u;
    const float sv = sign * v;
    const float sw = sign * w;
    if (su >= 0.0f && sv >= 0.0f && sw >= 0.0f) {
      // The very bits of ox_meets.
      if (!ox_meets(cast, corner_a, corner_b, corner_c, &crossing.t, &crossing.back))
        return crossing;
      crossing.triangle = first + k;
      crossing.interior = ox_keeps_off(u, b, c, epsilon) && ox_keeps_off(v, c, a, epsilon) &&
                          ox_keeps_off(w, a, b, epsilon);
      return crossing;
    }
    // Across the edge that the line passes farthest outside of.
    k = su <= sv && su <= sw ? triangle->across_bc
                             : (sv <= sw ? triangle->across_ca : triangle->across_ab);
    if (k == OX_NONE) return crossing;
  }
  return crossing;
}

static inline float ox_distance(float3 a, float3 b) {
  const float3 d = a - b;
  return sqrt(ox_dot(d, d));
}

// Whether the line meets nothing but `crossing` between its points `from` and `to` (both along
// +-direction from the vertex).
static inline bool ox_alone_between(__global const ox_triangle* triangle,
                                    __global const ox_isolation* isolation, float3 direction,
                                    float3 from, float3 to, float epsilon) {
  // cos of the angle between line and normal. A triangle that faces within 30 degrees of this one
  // faces the line's way if that angle is below 60 degrees, and so on; 1e-5 covers the rounding of
  // two unit vectors (2^-22) a hundred times.
  const float slope = fabs(ox_dot(direction, vload3(0, triangle->normal)));
  const float radius = slope > 0.86604f   ? isolation->within_60
                       : slope > 0.50001f ? isolation->within_30
                       : slope > 0.17366f ? isolation->within_10
                                          : 0.0f;
  const float3 middle =
      (vload3(0, triangle->a) + vload3(0, triangle->b) + vload3(0, triangle->c)) / 3.0f;
  // Within epsilon of either end another face would matter too.
  const float room = radius - 4.0f * epsilon;
  return ox_distance(from, middle) < room && ox_distance(to, middle) < room;
}

// True: *outcome is what the full algorithms would give, or, without `proof`, what the paper takes
// for it. *triangle: in, over the target's triangles, where to start; out, over all meshes, where
// the line crosses, or OX_NONE.
static inline bool ox_cast_iteratively(const ox_vertex_ray* ray, __global const ox_mesh* mesh,
                                       __global const ox_triangle* triangles,
                                       __global const ox_isolation* isolations, uint walk_limit,
                                       bool proof, float behind, uint* triangle,
                                       ox_outcome* outcome, uint* work) {
  const float epsilon = ray->epsilon;
  const ox_cast cast = ox_cast_from(ray->origin, ray->direction);
  const ox_crossing crossing =
      ox_walk(&cast, triangles, mesh->triangle_first, *triangle, walk_limit, epsilon, work);
  *triangle = crossing.triangle;
  *outcome = ox_miss();
  if (crossing.triangle == OX_NONE) return false;

  // A sheet's vertex leaves by the shorter way, so for it the line has no direction of its own.
  const bool two_sided = (mesh->flags & OX_MESH_TWO_SIDED) != 0u;
  const bool turned = ray->both_ways && (two_sided || !crossing.back) && crossing.t < 0.0f;
  const float3 direction = turned ? -ray->direction : ray->direction;
  const float t = turned ? -crossing.t : crossing.t;
  const bool back = two_sided || crossing.back != turned;
  if (proof) {
    // A crossing at the vertex itself is a matter of touching, one on an edge of which triangle; an
    // entry behind it proves the vertex inside, but not where it leaves.
    if (fabs(t) <= epsilon || !crossing.interior || (!back && t < 0.0f)) return false;
    // Outside, but so close to the surface that rays in other directions might start on it.
    const float slope = ox_dot(direction, vload3(0, triangles[crossing.triangle].normal));
    if (t < 0.0f && fabs(t * slope) <= epsilon) return false;
    const float3 hit = ray->origin + t * direction;
    if (!ox_alone_between(triangles + crossing.triangle, isolations + crossing.triangle, direction,
                          ray->origin, hit, epsilon))
      return false;
    if (ray->both_ways &&
        !ox_alone_between(triangles + crossing.triangle, isolations + crossing.triangle, direction,
                          ray->origin, ray->origin - t * direction, epsilon))
      return false;
  }
  if (!back || t < 0.0f) {  // outside; a face that is far behind is no use to the next step
    if (t < -behind) *triangle = OX_NONE;
    return true;
  }
  const bool closed = (mesh->flags & OX_MESH_CLOSED) != 0u;
  if (!closed && t > ray->exit + epsilon) return true;
  const float slope = ox_dot(direction, vload3(0, triangles[crossing.triangle].normal));
  const bool reversed = two_sided && slope < 0.0f;
  *outcome = ox_exit_through(triangles, crossing.triangle, reversed ? -direction : direction, t,
                             ray->exit, epsilon);
  if (reversed) outcome->kind |= OX_HIT_REVERSED;
  // As the paper: a hit beyond the vertex's own exit is not its contact.
  if (!proof && (outcome->kind & OX_HIT_KIND) != OX_HIT_INSIDE) *outcome = ox_miss();
  return true;
}

#endif
