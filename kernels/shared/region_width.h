// SPDX-License-Identifier: BSD-3-Clause
// How wide a region of overlap is. Two convex bodies that overlap have to move along a direction by
// at least as much as their overlap is wide along it for a plane across that direction to part
// them; a contact that says less was made where they are not deepest. Frame of B. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_REGION_WIDTH_H
#define ODE_EXT_KERNELS_SHARED_REGION_WIDTH_H

#include "shared/way_out.h"

// Regions of more crossings are let be, for the time it takes: where surfaces are so fine, vertices
// are mostly near where they are deepest.
#define OX_MOST_CORNERS 32u

// The corners of a convex region are its crossings and the vertices inside at the ends of its
// chords: so many at each crossing.
static inline uint ox_corners_at(__global const ox_pair_crossing* c) {
  return c->other == OX_NONE ? 2u : 1u;
}

// The corners farthest along a direction and against it.
typedef struct {
  float low, high;       // [m] along it
  uint lowest, highest;  // crossings; OX_NONE: there is no corner
  float3 lowest_corner, highest_corner;
} ox_extent;

static inline ox_extent ox_extent_of(const ox_edge_pair* p, float3 direction) {
  ox_extent extent;
  extent.low = INFINITY;
  extent.high = -INFINITY;
  extent.lowest = OX_NONE;
  extent.highest = OX_NONE;
  extent.lowest_corner = (float3)(0.0f);
  extent.highest_corner = (float3)(0.0f);
  for (uint k = 0u; k < p->count; ++k) {
    const uint i = p->order[k];
    __global const ox_pair_crossing* c = p->crossings + i;
    for (uint end = 0u; end < ox_corners_at(c); ++end) {
      const float3 corner = ox_chord_end(p, c, end);
      const float at = ox_dot(corner, direction);
      if (at < extent.low) {
        extent.low = at;
        extent.lowest = i;
        extent.lowest_corner = corner;
      }
      if (at > extent.high) {
        extent.high = at;
        extent.highest = i;
        extent.highest_corner = corner;
      }
    }
  }
  return extent;
}

// Whether all of it lies behind the plane of every face at its crossings.
static inline bool ox_is_convex(const ox_edge_pair* p) {
  for (uint k = 0u; k < p->count; ++k) {
    __global const ox_pair_crossing* c = p->crossings + k;
    const float3 position = vload3(0, c->position);
    for (uint f = 0u; f < 3u; ++f) {
      const uint face = f == 2u ? c->triangle : p->edges[c->edge].triangle[f];
      if (face == OX_NONE) return false;
      const float3 normal = ox_normal_in_b(p, f == 2u ? 1u - ox_side(c) : ox_side(c), face);
      const float limit = ox_dot(position, normal) + p->pair->epsilon;
      for (uint i = 0u; i < p->count; ++i) {
        __global const ox_pair_crossing* d = p->crossings + i;
        for (uint end = 0u; end < ox_corners_at(d); ++end)
          if (ox_dot(ox_chord_end(p, d, end), normal) > limit) return false;
      }
    }
  }
  return true;
}

// The order of contacts that are equal otherwise, whatever that of the hits was; points were added
// in theirs.
static inline bool ox_is_listed_before(__global const ox_candidate* a,
                                       __global const ox_candidate* b) {
  if (a->side_kind != b->side_kind) return a->side_kind < b->side_kind;
  if (a->vertex != b->vertex) return a->vertex < b->vertex;
  return a->triangle < b->triangle;
}

// The deepest contact; OX_NONE: none is inside.
static inline uint ox_deepest(const ox_edge_pair* p) {
  uint deepest = OX_NONE;
  for (uint i = 0u; i < p->candidate_count; ++i) {
    __global const ox_candidate* c = p->candidates + i;
    if ((c->side_kind & OX_HIT_KIND) != OX_HIT_INSIDE) continue;
    if (deepest != OX_NONE) {
      __global const ox_candidate* d = p->candidates + deepest;
      if (!(c->depth > d->depth || (c->depth == d->depth && ox_is_listed_before(c, d)))) continue;
    }
    deepest = i;
  }
  return deepest;
}

// The contact along whose normal the region is least wide; OX_NONE: none is inside.
static inline uint ox_narrowest(const ox_edge_pair* p, ox_extent* least) {
  uint narrowest = OX_NONE;
  uint measured = OX_NONE;  // the last one; its neighbours mostly face the same way
  ox_extent extent = *least;
  for (uint i = 0u; i < p->candidate_count; ++i) {
    __global const ox_candidate* c = p->candidates + i;
    if ((c->side_kind & OX_HIT_KIND) != OX_HIT_INSIDE) continue;
    const float3 direction = vload3(0, c->normal);
    if (measured == OX_NONE || any(direction != vload3(0, p->candidates[measured].normal)))
      extent = ox_extent_of(p, direction);
    measured = i;
    const float wider = (extent.high - extent.low) - (least->high - least->low);
    if (narrowest != OX_NONE &&
        (wider > 0.0f || (wider == 0.0f && !ox_is_listed_before(c, p->candidates + narrowest))))
      continue;
    narrowest = i;
    *least = extent;
  }
  return narrowest;
}

#endif
#endif
