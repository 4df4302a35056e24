// SPDX-License-Identifier: BSD-3-Clause
// Regions of overlap whose contacts would all be left out because those of another region push the
// other way. Where the parts are led out by two faces of one thin part (two legs through a plate,
// each by the face that is nearer to it), a rigid body leaves all of it the same way, the way that
// stands. Where that is far (a foot on the floor, the head at the ceiling) both stand. Frame of B.
// Device only.
#ifndef ODE_EXT_KERNELS_SHARED_RECONCILE_H
#define ODE_EXT_KERNELS_SHARED_RECONCILE_H

#include "shared/contradiction.h"
#include "shared/pair_hits.h"
#include "shared/way_out.h"

// The shallowest contact that this one contradicts and that is less deep; OX_NONE: there is none.
static inline uint ox_find_contradictor(const ox_edge_pair* p, uint i) {
  __global const ox_candidate* c = p->candidates + i;
  uint least = OX_NONE;
  for (uint k = 0u; k < p->candidate_count; ++k) {
    __global const ox_candidate* d = p->candidates + k;
    if (k == i || ox_kind(d) != OX_HIT_INSIDE || !ox_deeper(c, d) ||
        !ox_contradicts(c, d, p->pair->epsilon))
      continue;
    if (least == OX_NONE || ox_deeper(p->candidates + least, d)) least = k;
  }
  return least;
}

// Whether a candidate is of the region: a point made for it, or the hit of a vertex at one of its
// chords. `points`: the first candidate that is a point.
static inline bool ox_is_of_region(const ox_edge_pair* p, uint points, uint region, uint i) {
  __global const ox_candidate* c = p->candidates + i;
  if (ox_kind(c) != OX_HIT_INSIDE) return false;
  if (i >= points) return c->region == region;
  const uint side = (c->side_kind & OX_HIT_SIDE) != 0u ? 1u : 0u;
  for (uint k = 0u; k < p->count; ++k) {
    __global const ox_edge_crossing* crossing = p->crossings + k;
    if (crossing->region == region && ox_side(crossing) == side &&
        ox_inner_vertex(p, crossing) == c->vertex)
      return true;
  }
  return false;
}

// What stands in the way of all contacts of the region, the shallowest; OX_NONE: one of them
// stands, or there are none.
static inline uint ox_find_standing(const ox_edge_pair* p, uint points, uint region) {
  uint least = OX_NONE;
  for (uint i = 0u; i < p->candidate_count; ++i) {
    if (!ox_is_of_region(p, points, region, i)) continue;
    const uint standing = ox_find_contradictor(p, i);
    if (standing == OX_NONE) return OX_NONE;
    if (least == OX_NONE || ox_deeper(p->candidates + least, p->candidates + standing))
      least = standing;
  }
  return least;
}

// Contacts that are deep for how near they are to one another tell of the same part, as those of
// bodies that coincide do: of them only the shallower stands.
static inline bool ox_are_of_different_parts(__global const ox_candidate* a,
                                             __global const ox_candidate* b) {
  const float3 away = vload3(0, a->position) - vload3(0, b->position);
  const float reach = 2.0f * ox_max(a->depth, b->depth);
  return ox_dot(away, away) > reach * reach;
}

// A way that is longer than so many times the region's own is not the way out of the same part.
#define OX_FARTHEST_WAY 2.0f

// Rays that look for a face that leads the way of what stands.
#define OX_MOST_LOOKS 4u

static inline void ox_try_way_along(const ox_edge_pair* p, uint region, float3 normal, uint side,
                                    uint face, ox_way_out* best) {
  if (face == OX_NONE || (p->mesh[1u - side]->flags & OX_MESH_CLOSED) == 0u) return;
  const float3 out = ox_normal_in_b(p, 1u - side, face);
  if (ox_dot(side == 0u ? out : -out, normal) > 0.9f)
    ox_try_way(p, region, false, side, face, best);
}

// The least deep way out of the region that leads the way of `normal`, within acos 0.9 as for
// patches: by a face at its crossings, or one that a ray that way from inside leaves by.
static inline ox_way_out ox_find_way_along(const ox_edge_pair* p, uint region, float3 normal,
                                           __global const ox_node* nodes) {
  ox_way_out best = ox_no_way_out();
  uint looks[2] = {0u, 0u};
  for (uint k = 0u; k < p->count; ++k) {
    __global const ox_edge_crossing* c = p->crossings + p->order[k];
    if (c->region != region) continue;
    const uint side = ox_side(c);
    ox_try_way_along(p, region, normal, side, c->triangle, &best);
    for (uint f = 0u; f < 2u; ++f)
      ox_try_way_along(p, region, normal, 1u - side, p->edges[c->edge].triangle[f], &best);
    if ((c->leaves != 0u && c->other != OX_NONE) || looks[side] == OX_MOST_LOOKS) continue;
    ++looks[side];
    const float3 middle = 0.5f * (ox_chord_end(p, c, 0u) + ox_chord_end(p, c, 1u));
    ox_try_way_along(p, region, normal, side,
                     ox_exit_face(p, side, middle, side == 0u ? normal : -normal, nodes), &best);
  }
  return best;
}

// Of the region, the shallowest.
static inline uint ox_find_shallowest(const ox_edge_pair* p, uint points, uint region) {
  uint least = OX_NONE;
  for (uint i = 0u; i < p->candidate_count; ++i)
    if (ox_is_of_region(p, points, region, i) &&
        (least == OX_NONE || ox_deeper(p->candidates + least, p->candidates + i)))
      least = i;
  return least;
}

// The contacts of the region up to `end` stand whatever contradicts them, or give way.
static inline void ox_settle_region(const ox_edge_pair* p, uint points, uint region, uint end,
                                    bool stands) {
  for (uint i = 0u; i < end; ++i) {
    if (!ox_is_of_region(p, points, region, i)) continue;
    if (stands)
      p->candidates[i].stands = 1u;
    else
      p->candidates[i].side_kind |= OX_HIT_NONE;
  }
}

#endif
