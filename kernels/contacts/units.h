// SPDX-License-Identifier: BSD-3-Clause
// The units of a region that is not whole, and what planes cost them. Device only.
#ifdef OX_PLANES
#ifndef ODE_EXT_KERNELS_CONTACTS_UNITS_H
#define ODE_EXT_KERNELS_CONTACTS_UNITS_H

#include "contacts/whole_region.h"

// The depth of a unit below a plane; infinite where the plane does not clear it: it is of the
// other mesh, or one end is above it.
static inline float ox_unit_depth(const ox_region_view* r, uint k, const ox_plane* plane) {
  __global const ox_member* unit = r->members + k;
  const uint side = ox_side_of(unit->flags);
  if (plane->kind == OX_PLANE_NONE || !ox_clears_side(plane, side)) return INFINITY;
  const float one = ox_plane_depth(plane, side, vload3(0, unit->position));
  const float other = ox_plane_depth(plane, side, vload3(0, unit->end));
  // A crossing lies on its face to within what A was made larger by, and what is not known.
  const float above = -OX_MARGIN * r->scene->pairs[r->pair].epsilon;
  if (ox_min(one, other) < above) return INFINITY;
  return ox_max(ox_max(one, other), 0.0f);
}

// Finds the planes that the features of a unit propose.
static inline void ox_propose_for(const ox_region_view* r, __global ox_member* unit) {
  uint count = 0u;
  uint feature = unit->feature;
  for (uint end = 0u; end < 2u; ++end) {
    __global const ox_feature* f = r->features + feature;
    if (f->triangle != OX_NONE && (f->flags & OX_FEATURE_FLAT) == 0u)
      unit->own[count++] =
          ox_plane_of_entry(r->scene, r->features, r->faces, feature << 2 | OX_FACE_OPPOSITE);
    for (uint k = 0u; k < 2u; ++k)
      if (!ox_is_vertex(f->flags) && f->mate[k] != OX_NONE) unit->own[count++] = f->mate[k];
    if (f->partner == OX_NONE || ox_is_vertex(f->flags)) break;
    feature = f->partner;
  }
  for (; count < OX_UNIT_PLANES; ++count) unit->own[count] = OX_NONE;
}

static inline void ox_measure_units(const ox_region_view* r) {
  for (uint k = 0u; k < r->count; ++k) {
    __global ox_member* unit = r->members + k;
    if (unit->state != OX_UNIT_WAITING) continue;
    ox_propose_for(r, unit);
    for (uint i = 0u; i < OX_UNIT_PLANES; ++i) {
      if (unit->own[i] == OX_NONE) continue;
      const ox_plane plane = ox_load_plane(r->planes + unit->own[i]);
      unit->least = ox_min(unit->least, ox_unit_depth(r, k, &plane));
    }
  }
}

// Whether feature a comes before b in an order that does not depend on their numbers.
static inline bool ox_is_before(__global const ox_feature* a, __global const ox_feature* b) {
  const uint kind_a = a->flags & (OX_FEATURE_SIDE | OX_FEATURE_VERTEX);
  const uint kind_b = b->flags & (OX_FEATURE_SIDE | OX_FEATURE_VERTEX);
  if (kind_a != kind_b) return kind_a < kind_b;
  if (a->source != b->source) return a->source < b->source;
  return a->triangle < b->triangle;
}

// The waiting unit that is deepest below its own best plane; OX_NONE: all are cleared.
static inline uint ox_deepest_unit(const ox_region_view* r) {
  uint best = OX_NONE;
  for (uint k = 0u; k < r->count; ++k) {
    if (r->members[k].state != OX_UNIT_WAITING) continue;
    if (best != OX_NONE) {
      const float least = r->members[best].least;
      if (r->members[k].least < least) continue;
      if (r->members[k].least == least && !ox_is_before(r->features + r->members[k].feature,
                                                        r->features + r->members[best].feature))
        continue;
    }
    best = k;
  }
  return best;
}

// Tries a plane for a unit; whether it is better than the best so far. `beyond`: as in the record.
static inline bool ox_try_unit(const ox_region_view* r, uint unit, const ox_plane* plane,
                               __global float* beyond, ox_plane_choice* best) {
  ox_plane_choice choice;
  choice.plane = *plane;
  choice.depth = ox_unit_depth(r, unit, plane);
  if (choice.depth == INFINITY) return false;
  const float tie = ox_edge_tie(r, plane);
  choice.judged = choice.depth + tie;
  if (!ox_is_better_choice(&choice, best)) return false;
  if (*beyond < 0.0f) *beyond = ox_depth_beyond(r, plane);
  choice.judged = ox_max(choice.depth, *beyond) + tie;
  if (!ox_is_better_choice(&choice, best)) return false;
  *best = choice;
  return true;
}

// Of all planes of the region the best for a unit.
static inline ox_plane_choice ox_choose_for(const ox_region_view* r, uint unit, uint* index) {
  ox_plane_choice best = ox_no_choice();
  for (uint i = 0u; i < r->plane_count; ++i) {
    const ox_plane plane = ox_load_plane(r->planes + i);
    if (ox_try_unit(r, unit, &plane, &r->planes[i].beyond, &best)) *index = i;
  }
  return best;
}

// The plane by which a move along another's normal by its depth clears a unit: that one, or else
// the least of its own and of those chosen that the move takes it past; OX_PLANE_NONE: there is
// none.
static inline ox_plane_choice ox_clears(const ox_region_view* r, uint k,
                                        const ox_plane_choice* move, const uint* chosen,
                                        uint chosen_count) {
  const float far = move->depth + OX_INFLATION * r->scene->pairs[r->pair].epsilon;
  ox_plane_choice by = ox_no_choice();
  by.plane = move->plane;
  by.depth = ox_unit_depth(r, k, &move->plane);
  if (by.depth <= far) return by;
  by = ox_no_choice();
  __global const ox_member* unit = r->members + k;
  for (uint i = 0u; i < chosen_count + OX_UNIT_PLANES; ++i) {
    if (i >= chosen_count && unit->least > far) break;
    const uint index = i < chosen_count ? chosen[i] : unit->own[i - chosen_count];
    if (index == OX_NONE) continue;
    ox_plane_choice choice;
    choice.plane = ox_load_plane(r->planes + index);
    choice.depth = choice.judged = ox_unit_depth(r, k, &choice.plane);
    if (choice.depth <= far * ox_dot(move->plane.normal, choice.plane.normal) &&
        ox_is_better_choice(&choice, &by))
      by = choice;
  }
  return by;
}

#endif
#endif
