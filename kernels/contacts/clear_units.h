// SPDX-License-Identifier: BSD-3-Clause
// The plane that a unit is cleared by, and what else the move past it clears. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_CLEAR_UNITS_H
#define ODE_EXT_KERNELS_CONTACTS_CLEAR_UNITS_H

#include "contacts/units.h"

// The planes chosen so far, and the moves along their normals.
typedef struct {
  uint count;
  ox_plane chosen[OX_MOST_PLANES];
  float far[OX_MOST_PLANES];    // [m] how far each goes
  float along[OX_MOST_PLANES];  // [m] how far the last goes along each
} ox_moves;

static inline void ox_add_move(const ox_region_view* r, const ox_plane_choice* choice,
                               ox_moves* moves) {
  const uint last = moves->count++;
  const float far = choice->depth + OX_INFLATION * r->scene->pairs[r->pair].epsilon;
  moves->chosen[last] = choice->plane;
  moves->far[last] = moves->along[last] = far;
  for (uint i = 0u; i < last; ++i)
    moves->along[i] = far * ox_dot(choice->plane.normal, moves->chosen[i].normal);
}

// How much of a move before it a move of `depth` along a normal takes back, at most [m]. That is
// added to what a plane costs: two that oppose one another jam the body between them.
static inline float ox_taken_back(const ox_moves* moves, float3 normal, float depth) {
  float most = 0.0f;
  for (uint i = 0u; i < moves->count; ++i)
    most = ox_max(most, -ox_min(moves->far[i], depth) * ox_dot(moves->chosen[i].normal, normal));
  return most;
}

// What a plane costs a unit that has to go so far.
static inline float ox_cost_of(const ox_region_view* r, const ox_moves* moves,
                               const ox_plane* plane, float depth) {
  return depth + ox_edge_tie(r, plane) + ox_taken_back(moves, plane->normal, depth);
}

// A unit that a plane is looked for.
typedef struct {
  uint unit;
  uint side;
  float3 through[2];  // the normals of the faces that it goes through, turned where they are of A
  uint count;         // of those
  const ox_moves* before;
  ox_refused refused;
} ox_seed;

static inline ox_seed ox_seed_of(const ox_region_view* r, uint unit, const ox_moves* before) {
  ox_seed seed;
  seed.before = before;
  seed.unit = unit;
  seed.side = ox_side_of(ox_flags_of(r, unit));
  seed.count = 0u;
  seed.refused.count = 0u;
  __global const ox_feature* f = ox_feature_of(r, unit);
  for (uint end = 0u; end < 2u && !ox_is_vertex(f->flags); ++end) {
    const float3 normal = ox_normal_of(r->scene, r->pair, 1u - seed.side, f->triangle);
    seed.through[seed.count++] = ox_way_of(seed.side, normal);
    if (f->partner == OX_NONE) break;
    f = r->scene->features + f->partner;
  }
  return seed;
}

static inline void ox_try_unit(const ox_region_view* r, const ox_seed* seed, const ox_plane* plane,
                               ox_plane_choice* best) {
  if (ox_is_refused(&seed->refused, plane, OX_WAY_OF_UNIT)) return;
  ox_plane_choice choice = ox_no_choice();
  choice.plane = *plane;
  choice.depth = ox_unit_depth(r, seed->unit, plane);
  if (choice.depth == INFINITY) return;
  choice.judged = ox_cost_of(r, seed->before, plane, choice.depth);
  if (!ox_is_better_choice(&choice, best)) return;
  // Where it goes on through a face that looks back, all of the body has to pass the plane.
  for (uint i = 0u; i < seed->count; ++i)
    if (ox_dot(plane->normal, seed->through[i]) < OX_LOOKS_BACK) {
      const float of_body = ox_depth_of_body(r, plane, seed->side, best->judged);
      choice.judged = ox_cost_of(r, seed->before, plane, ox_max(choice.depth, of_body));
      break;
    }
  if (ox_is_better_choice(&choice, best)) *best = choice;
}

// A bit for each plane of a block that clears a unit by a move of `limit` at most.
static inline uint ox_clearing_planes(const ox_region_view* r, uint block, uint unit, float limit) {
  const uint side = ox_side_of(ox_flags_of(r, unit));
  const float past = -OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  ox_floats one, other;
  ox_dot_fields(&r->planes, OX_PLANE_NORMAL, block, ox_position_of(r, unit), &one);
  ox_dot_fields(&r->planes, OX_PLANE_NORMAL, block, ox_vector_of(&r->members, OX_MEMBER_END, unit),
                &other);
  const ox_floats level = OX_LOAD_FLOATS(&r->planes, OX_PLANE_LEVEL + side, block);
  one = side == 0u ? level - one : level + one;
  other = side == 0u ? level - other : level + other;
  const ox_ints clears = (one + other >= past + past) & (one <= limit) & (other <= limit);
  // Those of other kinds clear the other mesh alone.
  const uint others = ox_of_kind(&r->planes, block, OX_PLANE_KIND,
                                 side == 0u ? OX_PLANE_FACE_OF_A : OX_PLANE_FACE_OF_B);
  return ox_mask_of(&clears) & ~others & ox_present_lanes(r->plane_count, block);
}

// Of all planes of the region, and a unit's own, the best for it. Its own is tried first: what
// costs more need not be looked at.
static inline ox_plane_choice ox_search_for(const ox_region_view* r, const ox_seed* seed) {
  ox_plane_choice best = ox_no_choice();
  const ox_plane own = ox_own_plane(r, seed->unit);
  ox_try_unit(r, seed, &own, &best);
  for (uint block = 0u; OX_VECTOR_WIDTH * block < r->plane_count; ++block) {
    uint clears = ox_clearing_planes(r, block, seed->unit, best.judged);
    for (; clears != 0u; clears &= clears - 1u) {
      const ox_plane plane = ox_load_plane(&r->planes, OX_VECTOR_WIDTH * block + ox_lowest(clears));
      ox_try_unit(r, seed, &plane, &best);
    }
  }
  return best;
}

static inline bool ox_unit_stays(const ox_region_view* r, const ox_seed* seed,
                                 const ox_plane_choice* choice) {
  return ox_stays_inside(r, seed->side, ox_middle_of(r, seed->unit), &choice->plane, choice->depth);
}

// The best plane for a unit. Where one does not separate it, the way along its normal is past all
// of both bodies. Of a surface that bends inwards there are many that cost less than what the unit
// proposes itself and do not separate it; so that is asked after few of them, and taken if it takes
// no more of the moves before it back.
static inline ox_plane_choice ox_choose_for(const ox_region_view* r, uint unit,
                                            const ox_moves* before) {
  ox_seed seed = ox_seed_of(r, unit, before);
  ox_plane_choice of_body = ox_no_choice();
  while (seed.refused.count < OX_FEW) {
    ox_plane_choice choice = ox_search_for(r, &seed);
    if (choice.plane.kind == OX_PLANE_NONE || !ox_is_better_choice(&choice, &of_body)) break;
    if (!ox_unit_stays(r, &seed, &choice)) return choice;
    ox_refuse(&seed.refused, &choice.plane);
    const float of_both = ox_max(choice.depth, ox_depth_of_both(r, choice.plane.normal));
    choice.judged = ox_cost_of(r, before, &choice.plane, of_both);
    if (ox_is_better_choice(&choice, &of_body)) of_body = choice;
  }
  if (seed.refused.count < OX_FEW) return of_body;
  ox_plane_choice own = of_body;
  const ox_plane plane = ox_own_plane(r, unit);
  ox_try_unit(r, &seed, &plane, &own);
  const float allowed = ox_taken_back(before, of_body.plane.normal, of_body.depth) +
                        OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  return ox_is_better_choice(&own, &of_body) &&
                 ox_taken_back(before, own.plane.normal, own.depth) <= allowed &&
                 !ox_unit_stays(r, &seed, &own)
             ? own
             : of_body;
}

// The plane by which the last move clears a unit: its own, or else the least of the unit's best and
// of those before that the move takes it past; OX_PLANE_NONE: there is none.
static inline ox_plane_choice ox_clearing_plane(const ox_region_view* r, uint k,
                                                const ox_moves* moves) {
  const uint last = moves->count - 1u;
  ox_plane_choice by = ox_no_choice();
  if (ox_take_better(r, k, moves->chosen + last, moves->far[last], &by)) return by;
  for (uint i = 0u; i < last; ++i)
    if (moves->along[i] >= 0.0f) ox_take_better(r, k, moves->chosen + i, moves->along[i], &by);
  const float3 normal = ox_vector_of(&r->members, OX_MEMBER_NORMAL, k);
  if (ox_floats_of(&r->members, OX_MEMBER_LEAST)[k] <=
      moves->far[last] * ox_dot(moves->chosen[last].normal, normal)) {
    const ox_plane plane = ox_own_plane(r, k);
    ox_take_better(r, k, &plane, INFINITY, &by);
  }
  return by;
}

// A bit for each unit of a block that a plane clears by a move so far along it.
static inline uint ox_cleared_by(const ox_region_view* r, uint block, const ox_plane* plane,
                                 float along) {
  const float past = -OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  const ox_ints is_b =
      (OX_LOAD_WORDS(&r->members, OX_MEMBER_FLAGS, block) & (int)OX_FEATURE_SIDE) != 0;
  const uint of_b = ox_mask_of(&is_b);
  ox_floats one, other;
  ox_dot_fields(&r->members, OX_MEMBER_POSITION, block, plane->normal, &one);
  ox_dot_fields(&r->members, OX_MEMBER_END, block, plane->normal, &other);
  uint cleared = 0u;
  for (uint side = 0u; side < 2u; ++side) {
    if (!ox_clears_side(plane, side)) continue;
    const ox_floats a = plane->level[side] + (side == 0u ? -one : one);
    const ox_floats b = plane->level[side] + (side == 0u ? -other : other);
    const ox_ints clears = (a + b >= past + past) & (a <= along) & (b <= along);
    cleared |= ox_mask_of(&clears) & (side == 0u ? ~of_b : of_b);
  }
  return cleared;
}

// A bit for each waiting unit of a block that the last move clears.
static inline uint ox_cleared_units(const ox_region_view* r, uint block, uint waiting,
                                    const ox_moves* moves) {
  const uint last = moves->count - 1u;
  uint cleared = 0u;
  for (uint i = 0u; i <= last; ++i)
    if (moves->along[i] >= 0.0f)
      cleared |= ox_cleared_by(r, block, moves->chosen + i, moves->along[i]);
  ox_floats cosine;
  ox_dot_fields(&r->members, OX_MEMBER_NORMAL, block, moves->chosen[last].normal, &cosine);
  const ox_ints past_own =
      OX_LOAD_FLOATS(&r->members, OX_MEMBER_LEAST, block) <= moves->far[last] * cosine;
  return (cleared | ox_mask_of(&past_own)) & ox_present_lanes(waiting, block);
}

#endif
