// SPDX-License-Identifier: BSD-3-Clause
// The units of a region that is not whole, and the planes that they propose. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_UNITS_H
#define ODE_EXT_KERNELS_CONTACTS_UNITS_H

#include "contacts/whole_region.h"

// The depth of a unit below a plane; infinite where the plane does not clear it: it is of the
// other mesh, or its middle is above it. (One end may be: where a surface is cut into facets that
// are turned against each other, an edge that goes along just below it is below the plane of none
// of them as a whole.)
static inline float ox_unit_depth(const ox_region_view* r, uint k, const ox_plane* plane) {
  const uint side = ox_side_of(ox_flags_of(r, k));
  if (plane->kind == OX_PLANE_NONE || !ox_clears_side(plane, side)) return INFINITY;
  const float one = ox_plane_depth(plane, side, ox_position_of(r, k));
  const float other = ox_plane_depth(plane, side, ox_vector_of(&r->members, OX_MEMBER_END, k));
  // A crossing lies on its face to within what A was made larger by, and what is not known.
  const float above = -OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  if (one + other < above + above) return INFINITY;
  return ox_max(ox_max(one, other), 0.0f);
}

// Takes a plane that clears a unit by a move of `limit` at most, if it is better. False: it is not.
static inline bool ox_take_better(const ox_region_view* r, uint k, const ox_plane* plane,
                                  float limit, ox_plane_choice* best) {
  ox_plane_choice choice = ox_no_choice();
  choice.plane = *plane;
  choice.depth = ox_unit_depth(r, k, plane);
  choice.judged = choice.depth + ox_edge_tie(r, plane);
  if (choice.depth == INFINITY || !(choice.depth <= limit) || !ox_is_better_choice(&choice, best))
    return false;
  *best = choice;
  return true;
}

// Takes a plane of the region as the best of those that a unit proposes, if it is.
static inline void ox_propose_for(const ox_region_view* r, uint k, uint index,
                                  ox_plane_choice* best) {
  if (index == OX_NONE) return;
  const ox_plane plane = ox_load_plane(&r->planes, index);
  if (ox_take_better(r, k, &plane, INFINITY, best))
    ox_words_of(&r->members, OX_MEMBER_PLANE)[k] = index;
}

// A face that is nearest to a unit need not be one that the region meets: it is not listed, and
// OX_MEMBER_PLANE is its triangle with this bit.
#define OX_OWN_NEAREST 0x80000000u

// The best of the planes that a unit proposes; OX_PLANE_NONE: there is none.
static inline ox_plane ox_own_plane(const ox_region_view* r, uint k) {
  const uint index = ox_words_of(&r->members, OX_MEMBER_PLANE)[k];
  if (index == OX_NONE) return ox_no_plane();
  if ((index & OX_OWN_NEAREST) == 0u) return ox_load_plane(&r->planes, index);
  return ox_plane_of_face(r->scene, r->pair, 1u - ox_side_of(ox_flags_of(r, k)),
                          index & ~OX_OWN_NEAREST);
}

static inline void ox_set_own(const ox_region_view* r, uint k, const ox_plane_choice* own) {
  ox_set_vector(&r->members, OX_MEMBER_NORMAL, k, own->plane.normal);
  ox_floats_of(&r->members, OX_MEMBER_LEAST)[k] = own->depth;
}

// Has a unit propose a face of the other mesh, whether or not the region meets it.
static inline void ox_propose_face(const ox_region_view* r, uint k, const ox_plane_choice* own) {
  ox_settle();
  ox_words_of(&r->members, OX_MEMBER_PLANE)[k] = own->plane.id[0] | OX_OWN_NEAREST;
  ox_set_own(r, k, own);
  ox_settle();
}

// Has a chord propose the nearest of the faces that its middle is behind too: it may go along below
// a face that nothing of the region meets. A vertex has the face that its ray leaves by (GRAPP),
// which serves as well: to ask for the nearest of vertices too made no nut on a bolt less deep, and
// took a third more for deep tori. But what is inside by no more than A is made larger may have a
// ray that meets none. Behind an open mesh it is not known how far, so the nearest tells nothing;
// what is in front of all that the region meets of that is outside.
static inline void ox_propose_nearest(const ox_region_view* r, uint k) {
  const uint flags = ox_flags_of(r, k);
  ox_settle();
  ox_words_of(&r->members, OX_MEMBER_FLAGS)[k] = flags | OX_MEMBER_NEAREST;
  const uint side = ox_side_of(flags);
  ox_settle();
  const bool is_none = ox_words_of(&r->members, OX_MEMBER_PLANE)[k] == OX_NONE;
  const bool is_open = (ox_target_of(r, side)->flags & OX_MESH_CLOSED) == 0u;
  if (!is_none && (ox_is_vertex(flags) || is_open)) return;
  ox_plane_choice own = ox_no_choice();
  own.plane = ox_own_plane(r, k);
  own.depth = ox_floats_of(&r->members, OX_MEMBER_LEAST)[k];
  own.judged = own.depth + ox_edge_tie(r, &own.plane);
  const float3 middle = ox_middle_of(r, k);
  const float clearance = OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  const ox_plane nearest = is_open ? ox_no_plane() : ox_nearest_behind(r, side, middle, own.judged);
  bool is_taken = ox_take_better(r, k, &nearest, INFINITY, &own);
  // From outside of a solid there is a face on its other side that a point is behind.
  if (is_taken && is_none && own.depth > clearance)
    is_taken = ox_is_still_inside(r, side, middle, ox_way_of(side, nearest.normal));
  if (!is_taken) {
    ox_settle();
    // After all that touch.
    if (is_none) ox_floats_of(&r->members, OX_MEMBER_LEAST)[k] = -2.0f * clearance;
    ox_settle();
    return;
  }
  ox_propose_face(r, k, &own);
}

// Whether a unit that has been asked for the nearest face is outside: where an edge leaves a solid
// and enters it again, as at a corner of its side, rounding may take the stretch between for one
// that is inside; a vertex may be so by as much as A is made larger.
static inline bool ox_is_outside(const ox_region_view* r, uint k) {
  return ox_words_of(&r->members, OX_MEMBER_PLANE)[k] == OX_NONE;
}

// The nearest face, whether or not it is behind that.
static inline ox_plane_choice ox_choose_nearest(const ox_region_view* r, uint k) {
  ox_plane_choice choice = ox_no_choice();
  const uint side = ox_side_of(ox_flags_of(r, k));
  choice.plane = ox_nearest_face(r, side, ox_middle_of(r, k), INFINITY);
  const float one = ox_plane_depth(&choice.plane, side, ox_position_of(r, k));
  const float other =
      ox_plane_depth(&choice.plane, side, ox_vector_of(&r->members, OX_MEMBER_END, k));
  choice.depth = choice.judged = ox_max(ox_max(one, other), 0.0f);
  return choice;
}

// Of the waiting units, the first of the members, the best of the planes that their features
// propose.
static inline void ox_measure_units(const ox_region_view* r, uint waiting) {
  for (uint k = OX_ITEM; k < waiting; k += OX_ITEMS) {
    ox_plane_choice best = ox_no_choice();
    ox_words_of(&r->members, OX_MEMBER_PLANE)[k] = OX_NONE;
    uint feature = ox_words_of(&r->members, OX_MEMBER_FEATURE)[k];
    for (uint end = 0u; end < 2u && feature != OX_NONE; ++end) {
      __global const ox_feature* f = r->scene->features + feature;
      if (f->face != OX_NONE) ox_propose_for(r, k, r->faces[f->face].plane, &best);
      for (uint i = 0u; i < 2u && !ox_is_vertex(f->flags); ++i)
        ox_propose_for(r, k, r->scene->edge_planes[2u * feature + i], &best);
      feature = f->partner;
    }
    ox_set_own(r, k, &best);
  }
  ox_settle();
}

// By one work-item.
static inline void ox_swap_members(const ox_region_view* r, uint a, uint b) {
  for (uint field = 0u; field < OX_MEMBER_WORDS; ++field) {
    __global uint* words = ox_words_of(&r->members, field);
    const uint kept = words[a];
    words[a] = words[b];
    words[b] = kept;
  }
}

// A bit for each of a block of the first `count` members whose flags under a mask are these.
static inline uint ox_members_of_kind(const ox_region_view* r, uint block, uint count, uint mask,
                                      uint flags) {
  const ox_ints is = (OX_LOAD_WORDS(&r->members, OX_MEMBER_FLAGS, block) & (int)mask) == (int)flags;
  return ox_mask_of(&is) & ox_present_lanes(count, block);
}

static inline uint ox_nth_bit(uint bits, uint n) {
  for (uint i = 0u; i < n; ++i) bits &= bits - 1u;
  return ox_lowest(bits);
}

// Brings those of the first `count` members whose flags under a mask are these before the others of
// them; returns how many they are.
static inline uint ox_bring_first(const ox_region_view* r, uint count, uint mask, uint flags) {
  uint kept = 0u;
  for (uint block = 0u; OX_VECTOR_WIDTH * block < count; ++block)
    kept += popcount(ox_members_of_kind(r, block, count, mask, flags));
  // Each that leaves changes places with one behind that comes: there are as many of either.
  uint leaving = 0u, coming = 0u;
  uint from = 0u, to = kept / OX_VECTOR_WIDTH;
  for (;;) {
    for (; leaving == 0u && OX_VECTOR_WIDTH * from < kept; ++from)
      leaving = ox_present_lanes(kept, from) & ~ox_members_of_kind(r, from, kept, mask, flags);
    if (leaving == 0u) break;
    for (; coming == 0u; ++to)
      coming = ox_members_of_kind(r, to, count, mask, flags) & ~ox_present_lanes(kept, to);
    const uint swaps = min(popcount(leaving), popcount(coming));
    ox_settle();
    for (uint i = OX_ITEM; i < swaps; i += OX_ITEMS)
      ox_swap_members(r, OX_VECTOR_WIDTH * (from - 1u) + ox_nth_bit(leaving, i),
                      OX_VECTOR_WIDTH * (to - 1u) + ox_nth_bit(coming, i));
    ox_settle();
    for (uint i = 0u; i < swaps; ++i) {
      leaving &= leaving - 1u;
      coming &= coming - 1u;
    }
  }
  return kept;
}

// The units of a block that wait.
typedef struct {
  ox_floats position[3], end[3];
  ox_ints is_b;
} ox_unit_block;

static inline void ox_load_units(const ox_region_view* r, uint block, ox_unit_block* units) {
  for (uint axis = 0u; axis < 3u; ++axis) {
    units->position[axis] = OX_LOAD_FLOATS(&r->members, OX_MEMBER_POSITION + axis, block);
    units->end[axis] = OX_LOAD_FLOATS(&r->members, OX_MEMBER_END + axis, block);
  }
  units->is_b = (OX_LOAD_WORDS(&r->members, OX_MEMBER_FLAGS, block) & (int)OX_FEATURE_SIDE) != 0;
}

// How deep both ends of units are below a plane that clears such of mesh `side`; which it clears.
static inline ox_ints ox_ends_below(const ox_unit_block* units, const ox_plane* plane, uint side,
                                    float past, ox_floats* one, ox_floats* other) {
  const float3 n = plane->normal;
  const ox_floats p =
      units->position[0] * n.x + units->position[1] * n.y + units->position[2] * n.z;
  const ox_floats q = units->end[0] * n.x + units->end[1] * n.y + units->end[2] * n.z;
  *one = plane->level[side] + (side == 0u ? -p : p);
  *other = plane->level[side] + (side == 0u ? -q : q);
  return (*one + *other >= past + past) & (side == 0u ? ~units->is_b : units->is_b);
}

#endif
