// SPDX-License-Identifier: BSD-3-Clause
// Which of the units that wait comes next: the deepest ones, then what is far from those that have
// a plane. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_UNIT_ORDER_H
#define ODE_EXT_KERNELS_CONTACTS_UNIT_ORDER_H

#include "contacts/unit_moves.h"

// What units are compared by, in metres: how deep each is below a plane, where that clears it and
// it proposes none that is less deep, by more than is not known; or, of those that are so deep
// below what they propose, how far each is from the units that planes were chosen for; or, where
// there is neither, how deep below what it proposes.
typedef struct {
  const ox_plane* below;
  const ox_moves* away;
  float least_depth;
  uint skipped;  // OX_MEMBER_... of those that do not count
} ox_unit_measure;

static inline void ox_depths_below(const ox_region_view* r, uint block, const ox_plane* plane,
                                   const ox_floats* proposed, ox_floats* depths) {
  const float above = -OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  ox_unit_block units;
  ox_load_units(r, block, &units);
  *depths = (ox_floats)(-INFINITY);
  for (uint side = 0u; side < 2u; ++side) {
    if (!ox_clears_side(plane, side)) continue;
    ox_floats one, other;
    const ox_ints clears = ox_ends_below(&units, plane, side, above, &one, &other);
    const ox_floats depth = OX_GREATER(one, other);
    const ox_ints is_less = clears & (depth + above <= *proposed);
    *depths = is_less != 0 ? depth : *depths;
  }
}

static inline void ox_distances_from(const ox_region_view* r, uint block, const ox_moves* moves,
                                     ox_floats* distances) {
  ox_unit_block units;
  ox_load_units(r, block, &units);
  ox_floats least2 = (ox_floats)(INFINITY);
  for (uint i = 0u; i < moves->count; ++i) {
    const ox_floats x = 0.5f * (units.position[0] + units.end[0]) - moves->at[i].x;
    const ox_floats y = 0.5f * (units.position[1] + units.end[1]) - moves->at[i].y;
    const ox_floats z = 0.5f * (units.position[2] + units.end[2]) - moves->at[i].z;
    const ox_floats off2 = x * x + y * y + z * z;
    least2 = OX_LESSER(off2, least2);
  }
  *distances = sqrt(least2);
}

// Of a block of units; -INFINITY of those that do not count.
static inline void ox_find_values(const ox_region_view* r, uint block,
                                  const ox_unit_measure* measure, ox_floats* values) {
  const ox_floats proposed = OX_LOAD_FLOATS(&r->members, OX_MEMBER_LEAST, block);
  *values = proposed;
  if (measure->below != 0) ox_depths_below(r, block, measure->below, &proposed, values);
  if (measure->skipped != 0u) {
    const ox_ints counts =
        (OX_LOAD_WORDS(&r->members, OX_MEMBER_FLAGS, block) & (int)measure->skipped) == 0;
    *values = counts ? *values : (ox_floats)(-INFINITY);
  }
  if (measure->away == 0) return;
  ox_distances_from(r, block, measure->away, values);
  *values = proposed >= measure->least_depth ? *values : (ox_floats)(-INFINITY);
}

// The waiting unit of the greatest value; OX_NONE: none counts. Of several that are as great, to
// within the clearance, the first: it is not for rounding to say which that is.
static inline uint ox_find_greatest(const ox_region_view* r, uint waiting,
                                    const ox_unit_measure* measure) {
  const uint blocks = (waiting + OX_VECTOR_WIDTH - 1u) / OX_VECTOR_WIDTH;
  ox_floats most = (ox_floats)(-INFINITY);
  for (uint block = 0u; block < blocks; ++block) {
    ox_floats values;
    ox_find_values(r, block, measure, &values);
    const ox_ints left = (int)(waiting - OX_VECTOR_WIDTH * block) - OX_LANE_NUMBERS;
    most = left > 0 && values > most ? values : most;
  }
  const float greatest = ox_greatest_of(&most);
  if (greatest == -INFINITY) return OX_NONE;
  const float least = greatest - OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  uint best = OX_NONE;
  for (uint block = 0u; block < blocks; ++block) {
    ox_floats values;
    ox_find_values(r, block, measure, &values);
    const ox_ints is_greatest = values >= least;
    const uint lanes = ox_mask_of(&is_greatest) & ox_present_lanes(waiting, block);
    best = ox_first_of(r, block, lanes, best);
  }
  return best;
}

// The waiting unit that is deepest below a plane.
static inline uint ox_deepest_below_plane(const ox_region_view* r, uint waiting,
                                          const ox_plane* plane, uint skipped) {
  const ox_unit_measure depth = {plane, 0, 0.0f, skipped};
  return ox_find_greatest(r, waiting, &depth);
}

// The waiting unit that is deepest below its own best plane; those of valleys come last. The
// nearest face makes it no deeper, but for the tie, so only those need it that are the deepest
// without.
static inline uint ox_deepest_unit(const ox_region_view* r, uint waiting) {
  for (;;) {
    uint k = ox_deepest_below_plane(r, waiting, 0, 0u);
    const uint flags = ox_flags_of(r, k);
    if ((flags & OX_MEMBER_NEAREST) != 0u && (flags & OX_MEMBER_VALLEY) != 0u) {
      const uint other = ox_deepest_below_plane(r, waiting, 0, OX_MEMBER_VALLEY);
      const bool is_asked = other != OX_NONE && (ox_flags_of(r, other) & OX_MEMBER_NEAREST) != 0u;
      if (other != OX_NONE && !(is_asked && ox_is_outside(r, other))) k = other;
    }
    if ((ox_flags_of(r, k) & OX_MEMBER_NEAREST) != 0u) return k;
    ox_propose_nearest(r, k);
  }
}

// The first half of the planes are for the deepest unit that is left. Those after them are, of the
// waiting units that are at least half as deep as the deepest of them, for the one that is farthest
// from those that planes were chosen for: facets all round a seat are as deep, and the first of
// them lie side by side. With that from the second plane on links of a chain of 96 segments are 11
// degrees off in place of less than 7: the deepest says which way a curved part goes out.
static inline uint ox_next_unit(const ox_region_view* r, uint waiting, const ox_moves* moves) {
  const uint deepest = ox_deepest_unit(r, waiting);
  if (moves->count < OX_MOST_PLANES / 2u) return deepest;
  const float depth = ox_floats_of(&r->members, OX_MEMBER_LEAST)[deepest];
  const ox_unit_measure distance = {
      0, moves, ox_min(depth, depth / OX_WORTH),
      (ox_flags_of(r, deepest) & OX_MEMBER_VALLEY) != 0u ? 0u : OX_MEMBER_VALLEY};
  const uint next = ox_find_greatest(r, waiting, &distance);
  if ((ox_flags_of(r, next) & OX_MEMBER_NEAREST) == 0u) ox_propose_nearest(r, next);
  return next;
}

#endif
