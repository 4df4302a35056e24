// SPDX-License-Identifier: BSD-3-Clause
// The iterative ray algorithm (GRAPP section 3, from Lehericey 2013): from the triangle that the
// line of this vertex met in the last pass, walk across edges to the one that it meets now. Device
// only.
//
// A triangle on the line need not be the first. The paper takes it for that; else a full ray looks
// at what lies before it (paper/cast.h).
#ifndef ODE_EXT_KERNELS_PAPER_ITERATIVE_RAY_H
#define ODE_EXT_KERNELS_PAPER_ITERATIVE_RAY_H

#include "lib/full_ray.h"

typedef struct {
  uint triangle;  // over all meshes; OX_NONE: the walk failed
  float t;        // [m] may be negative
  bool back;
} ox_crossing;

static inline float2 ox_sheared(const ox_cast* cast, float3 corner) {
  const float3 p = corner - cast->base - cast->origin;
  const float z = ox_axis(p, cast->kz);
  return (float2)(fma(-cast->sx, z, ox_axis(p, cast->kx)), fma(-cast->sy, z, ox_axis(p, cast->ky)));
}

// The triangle across a side of another; OX_NONE: there is none. Where more than two meet it is one
// of them: only the paper's rule takes what a walk over it finds for the first.
static inline uint ox_across(__global const ox_edge* edges, uint triangle, uint at_side) {
  if (at_side == OX_NONE) return OX_NONE;
  if ((at_side & OX_WITHIN_FACET) != 0u) return at_side & ~OX_WITHIN_FACET;
  __global const ox_edge* edge = edges + at_side;
  return edge->triangle[0] == triangle ? edge->triangle[1] : edge->triangle[0];
}

static inline ox_crossing ox_walk(const ox_cast* cast, const ox_scene* scene, uint start,
                                  uint limit, uint* work) {
  ox_crossing crossing;
  crossing.triangle = OX_NONE;
  uint k = start;
  for (uint crossed = 0u; crossed <= limit; ++crossed) {
    *work += OX_WORK_TRIANGLE;
    __global const ox_triangle* triangle = scene->surfaces.triangles + k;
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
      crossing.triangle = k;
      return crossing;
    }
    // Across the edge that the line passes farthest outside of.
    k = ox_across(scene->edges, k,
                  su <= sv && su <= sw ? triangle->side_bc
                                       : (sv <= sw ? triangle->side_ca : triangle->side_ab));
    if (k == OX_NONE) return crossing;
  }
  return crossing;
}

// True: *outcome is what the paper takes for the first hit. *triangle: in, over the target's
// triangles, where to start; out, over all meshes, where the line crosses, or OX_NONE.
static inline bool ox_cast_iteratively(const ox_scene* scene, const ox_vertex_ray* ray,
                                       __global const ox_mesh* mesh, uint walk_limit, float behind,
                                       uint* triangle, ox_outcome* outcome, uint* work) {
  __global const ox_triangle* triangles = scene->surfaces.triangles;
  const float epsilon = ray->epsilon;
  const ox_cast cast = ox_cast_from(ray->base, ray->origin, ray->direction);
  const ox_crossing crossing =
      ox_walk(&cast, scene, mesh->triangle_first + *triangle, walk_limit, work);
  *triangle = crossing.triangle;
  *outcome = ox_miss();
  if (crossing.triangle == OX_NONE) return false;

  // A sheet's vertex leaves by the shorter way, so for it the line has no direction of its own.
  const bool two_sided = (mesh->flags & OX_MESH_TWO_SIDED) != 0u;
  const bool turned = ray->both_ways && (two_sided || !crossing.back) && crossing.t < 0.0f;
  const float3 direction = turned ? -ray->direction : ray->direction;
  const float t = turned ? -crossing.t : crossing.t;
  const bool back = two_sided || crossing.back != turned;
  if (!back || t < 0.0f) {  // outside; a face that is far behind is no use to the next pass
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
  if ((outcome->kind & OX_HIT_KIND) != OX_HIT_INSIDE) *outcome = ox_miss();
  return true;
}

#endif
