// SPDX-License-Identifier: BSD-3-Clause
// Flat bodies of one layer that are below a ground all over. Device only.
//
// Such a body is through as soon as it is below, and has no thickness that would cross the ground.
// Nothing tells that it has come from above but that it is below by so little all over, as what
// has come to lie there is. A cup whose bottom is as near below a shelf hangs under it.
#ifndef ODE_EXT_KERNELS_LIB_BELOW_GROUND_H
#define ODE_EXT_KERNELS_LIB_BELOW_GROUND_H

#include "lib/border.h"
#include "lib/closest.h"
#include "lib/flat.h"
#include "lib/flood_state.h"
#include "lib/transform.h"

// [1] of its radius, how far below: as far as contacts are merged (contacts/constants.h).
#define OX_LIES_BELOW 0.02f
// The cosine of what is straight below, within 26 degrees: as of what faces the same way.
#define OX_STRAIGHT_BELOW 0.9f

// The closest triangle of the target within a bound [m].
static inline uint ox_closest_of_target(const ox_flood_state* s, float3 base, float3 p,
                                        float bound) {
  return ox_closest_triangle(&s->scene->surfaces, s->target, base, p, bound, s->pair->epsilon);
}

// Whether the source is a body of one layer, its target the ground of that, and all of it is below
// the planes of the faces that are closest, and half of it straight below these: the rest may jut
// out over the border of the ground, or lie on another. All of it is as near to one of these planes
// too, past which it leaves: a curved one would be as deep as it is curved. Of a facet its border
// is asked.
static inline bool ox_is_just_below_ground(const ox_flood_state* s) {
  if ((s->source->flags & OX_MESH_CLOSED) != 0u || !ox_is_ground_of(s->target, s->source))
    return false;
  const uint side = s->pair_side & 1u;
  const float3 base = ox_base(s->pair, 1u - side);
  const float depth = ox_min(OX_LIES_BELOW * s->source->radius, s->source->reach);
  __global const ox_triangle* first = 0;
  uint asked = 0u, straight = 0u;
  for (uint k = 0u; k < s->source->chunk_count; ++k) {
    __global const ox_chunk* chunk = s->scene->chunks + s->source->chunk_first + k;
    for (uint v = chunk->first; v < chunk->first + chunk->count; ++v) {
      if (ox_is_flat_vertex(s->scene, s->pair, side, v)) continue;
      const float3 p = ox_place(s->pair, side, vload3(0, s->scene->vertices[v].position));
      // It is near, mostly.
      uint closest = ox_closest_of_target(s, base, p, depth);
      if (closest == OX_NONE) closest = ox_closest_of_target(s, base, p, 2.0f * s->source->radius);
      if (closest == OX_NONE) return false;
      __global const ox_triangle* t = s->scene->surfaces.triangles + closest;
      if (asked == 0u) first = t;
      const float below = -ox_height_over(t, base, p);
      if (below < 0.0f || below > depth || fabs(ox_height_over(first, base, p)) > depth)
        return false;
      ++asked;
      const float near = below / OX_STRAIGHT_BELOW + s->pair->margin;
      if (ox_closest_of_target(s, base, p, near) != OX_NONE) ++straight;
    }
  }
  return straight != 0u && 2u * straight >= asked;
}

#endif
