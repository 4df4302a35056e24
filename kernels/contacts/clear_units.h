// SPDX-License-Identifier: BSD-3-Clause
// What else the move past the plane of a unit clears. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_CLEAR_UNITS_H
#define ODE_EXT_KERNELS_CONTACTS_CLEAR_UNITS_H

#include "contacts/unit_plane.h"

// The plane by which the last move clears a unit: its own; or else the least of the unit's best and
// of those before that the move takes it past; but where that is the unit's and faces another way,
// the face that lies on the move's plane; OX_PLANE_NONE: there is none.
static inline ox_plane_choice ox_clearing_plane(const ox_region_view* r, uint k,
                                                const ox_moves* moves) {
  const uint last = moves->count - 1u;
  ox_plane_choice by = ox_no_choice();
  if (ox_take_better(r, k, moves->chosen + last, moves->far[last], &by)) return by;
  for (uint i = 0u; i < last; ++i)
    if (moves->along[i] >= 0.0f) ox_take_better(r, k, moves->chosen + i, moves->along[i], &by);
  const float3 normal = ox_vector_of(&r->members, OX_MEMBER_NORMAL, k);
  const float cosine = ox_dot(moves->chosen[last].normal, normal);
  if (ox_floats_of(&r->members, OX_MEMBER_LEAST)[k] <= moves->far[last] * cosine) {
    const ox_plane plane = ox_own_plane(r, k);
    if (plane.kind == OX_PLANE_NONE) return by;
    const ox_plane on = ox_plane_on(r, moves, last);
    if (cosine <= OX_SAME_WAY && by.plane.kind == OX_PLANE_NONE &&
        ox_take_better(r, k, &on, moves->far[last], &by))
      return by;
    ox_take_better(r, k, &plane, INFINITY, &by);
  }
  return by;
}

// Adds those that a plane clears by a move so far along it.
static inline void ox_add_cleared_by(const ox_unit_block* units, const ox_plane* plane, float along,
                                     float past, ox_ints* cleared) {
  for (uint side = 0u; side < 2u; ++side) {
    if (!ox_clears_side(plane, side)) continue;
    ox_floats one, other;
    const ox_ints clears = ox_ends_below(units, plane, side, past, &one, &other);
    *cleared |= clears & (one <= along) & (other <= along);
  }
}

// Of blocks of waiting units, as many as are looked at at once, those that the last move clears: a
// bit for each.
static inline void ox_find_cleared(const ox_region_view* r, uint first, uint waiting,
                                   const ox_moves* moves, uint* bits) {
  const uint last = moves->count - 1u;
  const uint last_block = (waiting - 1u) / OX_VECTOR_WIDTH;
  const float past = -OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  ox_unit_block units[OX_BLOCKS_AT_ONCE];
  ox_ints cleared[OX_BLOCKS_AT_ONCE];
  for (uint k = 0u; k < OX_BLOCKS_AT_ONCE; ++k) {
    const uint block = min(first + k, last_block);
    ox_load_units(r, block, units + k);
    ox_floats cosine;
    ox_dot_fields(&r->members, OX_MEMBER_NORMAL, block, moves->chosen[last].normal, &cosine);
    // By the best plane of its own.
    cleared[k] = OX_LOAD_FLOATS(&r->members, OX_MEMBER_LEAST, block) <= moves->far[last] * cosine;
  }
  for (uint i = 0u; i <= last; ++i) {
    if (moves->along[i] < 0.0f) continue;
    for (uint k = 0u; k < OX_BLOCKS_AT_ONCE; ++k)
      ox_add_cleared_by(units + k, moves->chosen + i, moves->along[i], past, cleared + k);
  }
  for (uint k = 0u; k < OX_BLOCKS_AT_ONCE; ++k)
    bits[k] = ox_mask_of(cleared + k) & ox_present_lanes(waiting, first + k);
}

#endif
