// SPDX-License-Identifier: BSD-3-Clause
// Regions of overlap whose contacts would all be left out because those of another region push the
// other way. Where the parts are led out by two faces of one thin part (two legs through a plate,
// each by the face that is nearer to it), a rigid body leaves all of it the same way, the way that
// stands. Where that is far (a foot on the floor, the head at the ceiling) both stand. Frame of B.
// Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_RECONCILE_H
#define ODE_EXT_KERNELS_SHARED_RECONCILE_H

#include "shared/contradiction.h"
#include "shared/pair_hits.h"
#include "shared/way_out.h"

// The points of each region, in no order, as they are now.
static inline void ox_link_points(const ox_edge_pair* p) {
  for (uint region = 0u; region < p->regions; ++region) p->point_of_region[region] = OX_NONE;
  for (uint i = p->hits; i < p->candidate_count; ++i) {
    __global uint* first = p->point_of_region + p->candidates[i].region;
    p->next_point[i - p->hits] = *first;
    *first = i;
  }
}

// Goes through the candidates of a region that are inside: the hits of vertices at its chords,
// maybe more than once, and its points.
typedef struct {
  uint crossing, end;  // in the order by region
  uint point;
} ox_members;

static inline ox_members ox_members_of(const ox_edge_pair* p, uint region) {
  ox_members members;
  members.crossing = p->region_first[region];
  members.end = ox_region_end(p, region);
  members.point = p->point_of_region[region];
  return members;
}

// OX_NONE: there are no more.
static inline uint ox_next_member(const ox_edge_pair* p, ox_members* members) {
  while (members->crossing < members->end) {
    const uint hit = p->crossings[p->by_region[members->crossing++]].hit;
    if (ox_is_inside_hit(p, hit)) return hit;
  }
  while (members->point != OX_NONE) {
    const uint point = members->point;
    members->point = p->next_point[point - p->hits];
    if (ox_kind(p->candidates + point) == OX_HIT_INSIDE) return point;
  }
  return OX_NONE;
}

// The shallower of two contacts; OX_NONE: there is none.
static inline uint ox_shallower(const ox_edge_pair* p, uint a, uint b) {
  if (a == OX_NONE || b == OX_NONE) return a == OX_NONE ? b : a;
  return ox_deeper(p->candidates + a, p->candidates + b) ? b : a;
}

static inline bool ox_is_contradicted_by(const ox_edge_pair* p, uint i, uint k) {
  __global const ox_candidate* d = p->candidates + k;
  return ox_kind(d) == OX_HIT_INSIDE && ox_deeper(p->candidates + i, d) &&
         ox_contradicts(p->candidates + i, d, p->pair->epsilon);
}

// The shallowest contact that this one contradicts and that is less deep; OX_NONE: there is none.
// `ordered`: so many candidates are in the order of their depths, those from `added` on are not.
static inline uint ox_find_contradictor(const ox_edge_pair* p, uint ordered, uint added, uint i) {
  uint least = OX_NONE;
  for (uint k = ordered; k-- > 0u && least == OX_NONE;) {
    const uint d = p->candidates[k].ordered;
    if (d == i) break;  // the rest is deeper
    if (ox_is_contradicted_by(p, i, d)) least = d;
  }
  for (uint d = added; d < p->candidate_count; ++d)
    if (ox_is_contradicted_by(p, i, d)) least = ox_shallower(p, least, d);
  return least;
}

// Of the region, the shallowest; OX_NONE: it has none.
static inline uint ox_find_shallowest(const ox_edge_pair* p, uint region) {
  ox_members members = ox_members_of(p, region);
  uint least = OX_NONE;
  for (uint i = ox_next_member(p, &members); i != OX_NONE; i = ox_next_member(p, &members))
    least = ox_shallower(p, least, i);
  return least;
}

// What stands in the way of all contacts of the region, the shallowest; OX_NONE: one of them
// stands. `standing`: what stands in the way of one of them.
static inline uint ox_find_standing(const ox_edge_pair* p, uint ordered, uint added, uint region,
                                    uint standing) {
  ox_members members = ox_members_of(p, region);
  for (uint i = ox_next_member(p, &members); i != OX_NONE && standing != OX_NONE;
       i = ox_next_member(p, &members)) {
    const uint other = ox_find_contradictor(p, ordered, added, i);
    standing = other == OX_NONE ? OX_NONE : ox_shallower(p, standing, other);
  }
  return standing;
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
static inline ox_way_out ox_find_way_along(const ox_edge_pair* p, uint region, float3 normal) {
  ox_way_out best = ox_no_way_out();
  uint looks[2] = {0u, 0u};
  for (uint k = p->region_first[region]; k < ox_region_end(p, region); ++k) {
    __global const ox_pair_crossing* c = p->crossings + p->by_region[k];
    const uint side = ox_side(c);
    ox_try_way_along(p, region, normal, side, c->triangle, &best);
    for (uint f = 0u; f < 2u; ++f)
      ox_try_way_along(p, region, normal, 1u - side, p->edges[c->edge].triangle[f], &best);
    if ((ox_leaves(c) && c->other != OX_NONE) || looks[side] == OX_MOST_LOOKS) continue;
    ++looks[side];
    const float3 middle = 0.5f * (ox_chord_end(p, c, 0u) + ox_chord_end(p, c, 1u));
    ox_try_way_along(p, region, normal, side,
                     ox_exit_face(p, side, middle, side == 0u ? normal : -normal), &best);
  }
  return best;
}

// The contacts that the region had before stand whatever contradicts them, or give way.
static inline void ox_settle_region(const ox_edge_pair* p, uint region, bool stands) {
  ox_members members = ox_members_of(p, region);
  for (uint i = ox_next_member(p, &members); i != OX_NONE; i = ox_next_member(p, &members)) {
    if (stands)
      p->candidates[i].side_kind |= OX_HIT_STANDS;
    else
      p->candidates[i].side_kind |= OX_HIT_NONE;
  }
}

#endif
#endif
