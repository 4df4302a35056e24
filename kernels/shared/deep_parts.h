// SPDX-License-Identifier: BSD-3-Clause
// Thin parts deep in the target: what is farther from the target's surface than from the other side
// of its own mesh, and that no contact leads out. Frame of B. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_DEEP_PARTS_H
#define ODE_EXT_KERNELS_SHARED_DEEP_PARTS_H

#include "shared/edge_axis.h"
#include "shared/pair_hits.h"
#include "shared/way_out.h"

// A region that has such a part is marked, in the flags of its first crossing.
static inline __global uint* ox_mark_of(const ox_edge_pair* p, uint region) {
  return &p->crossings[p->by_region[p->region_first[region]]].flags;
}

static inline bool ox_is_marked(const ox_edge_pair* p, uint region) {
  return (*ox_mark_of(p, region) & OX_CROSSING_MARKED) != 0u;
}

// A vertex beyond its own exit, and not because surfaces run along one another (nearest.h).
static inline bool ox_is_deep(const ox_edge_pair* p, uint i, uint side) {
  return ox_is_fallback(p, i, side) &&
         p->candidates[i].t > p->vertices[p->candidates[i].vertex].exit + 2.0f * p->pair->epsilon;
}

// Whether the way out that a contact says leads a point of the source out as well; exit: how thick
// the source is there.
static inline bool ox_leads_out(const ox_edge_pair* p, __global const ox_candidate* d, uint side,
                                float3 point, float exit) {
  if ((d->side_kind & OX_HIT_KIND) != OX_HIT_INSIDE) return false;
  const bool same_side = ((d->side_kind & OX_HIT_SIDE) != 0u) == (side != 0u);
  // Its plane is only as wide as the part is thick, twice: farther off nothing is known of the
  // surface it stands for.
  const float3 away = vload3(0, d->position) - point;
  const float reach = 2.0f * ox_max(d->depth, exit);
  if (ox_dot(away, away) > reach * reach) return false;
  float3 out = vload3(0, d->normal);
  if (side != 0u) out = -out;
  // The target's surface there: the face it leaves through, or that about the target's vertex.
  float3 surface = vload3(0, d->position);
  float3 normal = out;
  if (same_side) {
    surface += d->depth * out;
  } else if ((d->side_kind & OX_HIT_POINT) == 0u) {
    normal = -vload3(0, p->vertices[d->vertex].direction);
    if (side == 1u) normal = ox_turn(p->pair, 0u, normal);  // the target is A
  }
  return ox_dot(surface - point, normal) <= 1.1f * d->depth * ox_dot(out, normal);
}

// Whether some contact does. `leader`: the one that did last mostly does again.
static inline bool ox_is_led_out(const ox_edge_pair* p, uint side, float3 point, float exit,
                                 uint* leader) {
  if (*leader < p->candidate_count && ox_leads_out(p, p->candidates + *leader, side, point, exit))
    return true;
  for (uint k = 0u; k < p->candidate_count; ++k) {
    if (!ox_leads_out(p, p->candidates + k, side, point, exit)) continue;
    *leader = k;
    return true;
  }
  return false;
}

// A crossing of the region that a vertex inside is in: one of a chord that ends there, or else (all
// edges at it are inside, or in a facet) the nearest.
static inline uint ox_crossing_near(const ox_edge_pair* p, uint i) {
  const float3 point = vload3(0, p->candidates[i].position);
  uint nearest = p->order[0];
  float least = INFINITY;
  // In order, so that the first of equals is always the same.
  for (uint k = 0u; k < p->count; ++k) {
    __global const ox_pair_crossing* c = p->crossings + p->order[k];
    if (c->hit == i) return p->order[k];
    const float3 away = vload3(0, c->position) - point;
    if (!(ox_dot(away, away) < least)) continue;
    least = ox_dot(away, away);
    nearest = p->order[k];
  }
  return nearest;
}

static inline void ox_mark_deep_vertices(const ox_edge_pair* p, uint side) {
  uint leader = 0u;
  uint marked = 0u;
  for (uint i = 0u; i < p->hits && marked < p->regions; ++i) {
    if (!ox_is_deep(p, i, side)) continue;
    const float3 position = vload3(0, p->candidates[i].position);
    const float exit = p->vertices[p->candidates[i].vertex].exit;
    if (ox_is_led_out(p, side, position, exit, &leader)) continue;
    const uint region = p->crossings[ox_crossing_near(p, i)].region;
    if (ox_is_marked(p, region)) continue;
    *ox_mark_of(p, region) |= OX_CROSSING_MARKED;
    ++marked;
  }
}

// The middle of a chord, looked at as if it were a vertex.
typedef struct {
  float3 position, inward;  // inward: unit
  uint exit;                // the face of the target that a ray inward meets
  float exit_t, own_t;      // [m] how far off that is; where the ray leaves its own mesh
  bool on_surface;          // of the target, and inside as rounding has it
} ox_middle;

// False: it is not inside, or the edge is concave and has no direction inward.
static inline bool ox_look_from_middle(const ox_edge_pair* p, __global const ox_pair_crossing* c,
                                       ox_middle* middle) {
  const uint side = ox_side(c);
  const ox_wedge wedge = ox_wedge_of(p, c);
  if (wedge.faces != 2u) return false;
  const float3 outward = wedge.normal[0] + wedge.normal[1];
  const float length2 = ox_dot(outward, outward);
  if (!ox_supports(&wedge, outward) || length2 < 1.0e-6f) return false;  // concave, or back to back
  middle->position = 0.5f * (ox_chord_end(p, c, 0u) + ox_chord_end(p, c, 1u));
  middle->inward = -outward / sqrt(length2);
  const ox_nearest exit = ox_look(p, 1u - side, middle->position, middle->inward);
  if (!(exit.back_t < exit.front_t)) return false;
  const ox_nearest own = ox_look(p, side, middle->position, middle->inward);
  middle->exit = exit.back;
  middle->on_surface = exit.entered;
  middle->exit_t = exit.back_t;
  middle->own_t = own.back_t < own.front_t ? own.back_t : INFINITY;
  return true;
}

// A long edge of a thin part runs deep through the target between ends that are not: the rim of a
// plate that sticks out of the block's far side, say, while its corner is near another. Where the
// part is cut finely it has deep vertices there.
static inline void ox_mark_deep_chords(const ox_edge_pair* p, uint side) {
  if ((p->mesh[0]->flags & p->mesh[1]->flags & OX_MESH_CLOSED) == 0u) return;
  uint leader = 0u;
  for (uint k = 0u; k < p->count; ++k) {
    __global const ox_pair_crossing* c = p->crossings + p->order[k];
    if (ox_side(c) != side || (ox_leaves(c) && c->other != OX_NONE) || ox_is_marked(p, c->region))
      continue;
    // Mostly some contacts lead out both ends, and what is between them with them. How thick the
    // source is there is not asked: that would take a ray for every chord.
    if (ox_is_led_out(p, side, ox_chord_end(p, c, 0u), INFINITY, &leader) &&
        ox_is_led_out(p, side, ox_chord_end(p, c, 1u), INFINITY, &leader))
      continue;
    ox_middle middle;
    if (ox_look_from_middle(p, c, &middle) &&
        middle.exit_t > middle.own_t + 2.0f * p->pair->epsilon)
      *ox_mark_of(p, c->region) |= OX_CROSSING_MARKED;
  }
}

// Whether the region was marked; no more then.
static inline bool ox_take_mark(const ox_edge_pair* p, uint region) {
  const bool marked = ox_is_marked(p, region);
  *ox_mark_of(p, region) &= ~OX_CROSSING_MARKED;
  return marked;
}

#endif
#endif
