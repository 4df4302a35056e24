// SPDX-License-Identifier: BSD-3-Clause
// How far an open target is solid behind its faces. Frame of B. Device only.
//
// As deep as the source is thick: what went through a ground is led back whence it came. But that
// something is behind a surface is known no farther off than the surface goes on to all sides;
// beyond, it may have come around the border. There the shorter part of a vertex's way through the
// source counts, as with a sheet. Else a patch that dips into a body would lead its far side out.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_OPEN_TARGET_H
#define ODE_EXT_KERNELS_SHARED_OPEN_TARGET_H

#include "shared/way_out.h"

static inline float ox_distance2_to_segment(float3 point, float3 a, float3 b) {
  const float3 along = b - a;
  const float length2 = ox_dot(along, along);
  const float s = length2 > 0.0f ? ox_dot(point - a, along) / length2 : 0.0f;
  const float3 away = point - (a + ox_min(ox_max(s, 0.0f), 1.0f) * along);
  return ox_dot(away, away);
}

static inline bool ox_is_of_border(const ox_edge_pair* p, uint target,
                                   __global const ox_pair_crossing* c) {
  return ox_side(c) == target && p->edges[c->edge].triangle[1] == OX_NONE;
}

static inline bool ox_crosses_with_border(const ox_edge_pair* p, uint target) {
  for (uint i = 0u; i < p->count; ++i)
    if (ox_is_of_border(p, target, p->crossings + i)) return true;
  return false;
}

// Whether the target goes on for `distance` about a point of it inside the source. Of its border
// only what crosses the source is looked at, if anything (`border`); needs the chords.
static inline bool ox_goes_on(const ox_edge_pair* p, uint target, bool border, float3 point,
                              float distance) {
  if (p->count == 0u) return false;  // what of it is inside is inside with its border
  if (distance > p->mesh[target]->radius) return false;
  for (uint i = 0u; i < p->count && border; ++i) {
    __global const ox_pair_crossing* c = p->crossings + i;
    if (ox_is_of_border(p, target, c) &&
        ox_distance2_to_segment(point, ox_chord_end(p, c, 0u), ox_chord_end(p, c, 1u)) <
            distance * distance)
      return false;
  }
  return true;
}

// Drops hits of vertices of a closed source that are farther behind an open target than is known.
static inline void ox_drop_beyond_border(const ox_edge_pair* p) {
  for (uint side = 0u; side < 2u; ++side) {
    if ((p->mesh[side]->flags & OX_MESH_CLOSED) == 0u ||
        (p->mesh[1u - side]->flags & (OX_MESH_CLOSED | OX_MESH_TWO_SIDED)) != 0u)
      continue;
    const bool border = ox_crosses_with_border(p, 1u - side);
    for (uint i = 0u; i < p->candidate_count; ++i) {
      __global ox_candidate* c = p->candidates + i;
      if ((c->side_kind & OX_HIT_KIND) != OX_HIT_INSIDE ||
          ((c->side_kind & OX_HIT_SIDE) != 0u) != (side != 0u) ||
          c->t <= 0.5f * p->vertices[c->vertex].exit + p->pair->epsilon)
        continue;
      float3 direction = vload3(0, p->vertices[c->vertex].direction);
      if (side == 0u) direction = ox_turn(p->pair, 0u, direction);
      const float3 hit = vload3(0, c->position) + c->t * direction;
      if (!ox_goes_on(p, 1u - side, border, hit, c->t))
        c->side_kind = (c->side_kind & ~OX_HIT_KIND) | OX_HIT_NONE;
    }
  }
}

#endif
#endif
