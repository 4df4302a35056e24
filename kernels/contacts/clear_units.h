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
  uint through[2];  // crossings by which it goes through the other mesh
  uint count;       // of those
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
  uint feature = ox_words_of(&r->members, OX_MEMBER_FEATURE)[unit];
  while (feature != OX_NONE && seed.count < 2u) {
    __global const ox_feature* f = r->scene->features + feature;
    if (ox_is_vertex(f->flags)) break;
    seed.through[seed.count++] = feature;
    feature = f->partner;
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
  // Where it goes on through a face that looks back, all of the body has to pass the plane, as of
  // a whole region.
  const float3 direction = ox_way_of(seed->side, plane->normal);
  for (uint i = 0u; i < seed->count; ++i) {
    __global const ox_feature* f = r->scene->features + seed->through[i];
    const float3 back = ox_normal_of(r->scene, r->pair, 1u - seed->side, f->triangle);
    if (!ox_looks_back(back, direction)) continue;
    const float worth = OX_WORTH * choice.depth;
    float of_body = ox_depth_of_body(r, plane, seed->side, best->judged);
    if (of_body > worth && worth <= best->judged &&
        !ox_edge_comes_back(r, seed->side, f, back, plane, choice.depth))
      of_body = worth;
    choice.judged = ox_max(choice.judged, ox_cost_of(r, seed->before, plane, of_body));
  }
  if (ox_is_better_choice(&choice, best)) *best = choice;
}

// The ends of a unit, by which its planes are looked for in many blocks.
typedef struct {
  float3 one, other;
  uint side;
  float past;  // [m] the least that a plane clears it by, of both ends
} ox_ends;

static inline ox_ends ox_ends_of(const ox_region_view* r, uint unit) {
  const float past = -OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  const ox_ends ends = {ox_position_of(r, unit), ox_vector_of(&r->members, OX_MEMBER_END, unit),
                        ox_side_of(ox_flags_of(r, unit)), past + past};
  return ends;
}

// A bit for each plane of a block that clears a unit by a move of `limit` at most.
static inline uint ox_clearing_planes(const ox_region_view* r, uint block, const ox_ends* ends,
                                      float limit) {
  ox_floats one, other;
  ox_dot_fields(&r->planes, OX_PLANE_NORMAL, block, ends->one, &one);
  ox_dot_fields(&r->planes, OX_PLANE_NORMAL, block, ends->other, &other);
  const ox_floats level = OX_LOAD_FLOATS(&r->planes, OX_PLANE_LEVEL + ends->side, block);
  one = ends->side == 0u ? level - one : level + one;
  other = ends->side == 0u ? level - other : level + other;
  // Those of other kinds clear the other mesh alone.
  const int others = (int)(ends->side == 0u ? OX_PLANE_FACE_OF_A : OX_PLANE_FACE_OF_B);
  const ox_ints clears =
      (one + other >= ends->past) & (one <= limit) & (other <= limit) &
      ((OX_LOAD_WORDS(&r->planes, OX_PLANE_FLAGS, block) & (int)OX_PLANE_KIND) != others);
  return ox_mask_of(&clears) & ox_present_lanes(r->plane_count, block);
}

// Of all planes of the region, and a unit's own, the best for it. Its own is tried first: what
// costs more need not be looked at.
static inline ox_plane_choice ox_search_for(const ox_region_view* r, const ox_seed* seed) {
  ox_plane_choice best = ox_no_choice();
  const ox_plane own = ox_own_plane(r, seed->unit);
  ox_try_unit(r, seed, &own, &best);
  const ox_ends ends = ox_ends_of(r, seed->unit);
  const uint blocks = (r->plane_count + OX_VECTOR_WIDTH - 1u) / OX_VECTOR_WIDTH;
  for (uint first = 0u; first < blocks; first += OX_BLOCKS_AT_ONCE) {
    uint clears[OX_BLOCKS_AT_ONCE];
    for (uint i = 0u; i < OX_BLOCKS_AT_ONCE; ++i)
      clears[i] = ox_clearing_planes(r, min(first + i, blocks - 1u), &ends, best.judged);
    for (uint i = 0u; i < OX_BLOCKS_AT_ONCE && first + i < blocks; ++i)
      for (; clears[i] != 0u; clears[i] &= clears[i] - 1u) {
        const uint k = OX_VECTOR_WIDTH * (first + i) + ox_lowest(clears[i]);
        const ox_plane plane = ox_load_plane(&r->planes, k);
        ox_try_unit(r, seed, &plane, &best);
      }
  }
  return best;
}

static inline bool ox_unit_stays(const ox_region_view* r, const ox_seed* seed,
                                 const ox_plane_choice* choice) {
  return ox_stays_inside(r, seed->side, ox_middle_of(r, seed->unit), &choice->plane, choice->depth);
}

// Planes of which none separates a unit alone, and which may do so together: at the foot of a wall
// it is behind the floor too.
typedef struct {
  ox_plane_choice first;  // the least of them
  float3 normal[OX_FEW];
  float far[OX_FEW];    // [m] how far it has to go along each
  float share[OX_FEW];  // [m] of the way along each
  float3 way;           // the sum of these: the shortest past all
  uint count;
  bool is_corner;  // one faces another way than the first
} ox_joint_choice;

// So often is each share mended for what the others are: where planes meet at 30 degrees, to within
// 2^-13 of the way, which is lengthened by what is lacking.
#define OX_SWEEPS 32u

static inline void ox_add_to_joint(const ox_region_view* r, float3 normal, float depth,
                                   ox_joint_choice* joint) {
  const uint last = joint->count++;
  joint->is_corner |= last != 0u && ox_dot(joint->normal[0], normal) <= OX_SAME_WAY;
  joint->normal[last] = normal;
  joint->far[last] = ox_way_past(r, depth);
  joint->share[last] = 0.0f;
  for (uint sweep = 0u; sweep < OX_SWEEPS; ++sweep)
    for (uint i = 0u; i <= last; ++i) {
      const float lacking = joint->far[i] - ox_dot(joint->way, joint->normal[i]);
      const float share = ox_max(joint->share[i] + lacking, 0.0f);
      joint->way += (share - joint->share[i]) * joint->normal[i];
      joint->share[i] = share;
    }
}

// How many times as long the way has to be to be past all, but for half of the margin; infinite: it
// never is.
static inline float ox_lacking_of(const ox_region_view* r, const ox_joint_choice* joint) {
  float longer = 1.0f;
  for (uint i = 0u; i < joint->count; ++i) {
    const float along = ox_dot(joint->way, joint->normal[i]);
    if (along + 0.5f * ox_way_past(r, 0.0f) >= joint->far[i]) continue;
    longer = along > 0.0f ? ox_max(longer, joint->far[i] / along) : INFINITY;
  }
  return longer;
}

// The least of them, where all together separate it, and do not face one way, as those of a surface
// that bends inwards do; else OX_PLANE_NONE. Where it is still inside past all, the nearest face
// that it is behind there is one more: of a corner the region need not meet all. A plane that
// separates it alone is better up to twice the price of all: it clears more.
static inline ox_plane_choice ox_leave_jointly(const ox_region_view* r, const ox_seed* seed,
                                               const ox_joint_choice* planes,
                                               const ox_plane_choice* known) {
  ox_joint_choice joint = *planes;
  const float3 one = ox_position_of(r, seed->unit);
  const float3 other = ox_vector_of(&r->members, OX_MEMBER_END, seed->unit);
  for (;;) {
    const float longer = ox_lacking_of(r, &joint);
    float sum = 0.0f;
    for (uint i = 0u; i < joint.count; ++i) sum += joint.share[i];
    ox_plane_choice choice = joint.first;
    choice.judged = OX_WORTH * (choice.judged - joint.far[0] + longer * sum);
    if (!ox_is_better_choice(&choice, known)) return ox_no_choice();
    const float3 way = ox_way_of(seed->side, longer * joint.way);
    const float3 p = 0.5f * (one + other) + way;
    const bool is_near =
        OX_SAME_WAY * OX_SAME_WAY * ox_dot(way, way) <= joint.far[0] * joint.far[0];
    if ((joint.is_corner || (joint.count > 1u && is_near)) &&
        !ox_is_still_inside(r, seed->side, p, way))
      return choice;
    if (joint.count == OX_FEW) return ox_no_choice();
    const ox_plane next = ox_nearest_of(r, seed->side, p, known->judged, true);
    if (next.kind == OX_PLANE_NONE) return ox_no_choice();
    ox_add_to_joint(
        r, next.normal,
        ox_max(ox_plane_depth(&next, seed->side, one), ox_plane_depth(&next, seed->side, other)),
        &joint);
  }
}

// The best plane for a unit. Where one does not separate it, that and those that do not either may
// do so together: then the least of them is its. Else the way along its normal is past all of both
// bodies. Of a surface that bends inwards there are many that cost less than what the unit proposes
// itself and do not separate it; so that is asked after few of them, and taken if it takes no more
// of the moves before it back.
static inline ox_plane_choice ox_choose_for(const ox_region_view* r, uint unit,
                                            const ox_moves* before) {
  ox_seed seed = ox_seed_of(r, unit, before);
  ox_plane_choice known = ox_no_choice();  // the best that does separate it
  ox_joint_choice joint;
  joint.count = 0u;
  joint.way = (float3)(0.0f);
  joint.is_corner = false;
  while (seed.refused.count < OX_FEW) {
    ox_plane_choice choice = ox_search_for(r, &seed);
    if (choice.plane.kind == OX_PLANE_NONE || !ox_is_better_choice(&choice, &known)) break;
    if (ox_only_touches(r, &choice) || !ox_unit_stays(r, &seed, &choice)) return choice;
    ox_refuse(&seed.refused, &choice.plane);
    if (joint.count == 0u) joint.first = choice;
    ox_add_to_joint(r, choice.plane.normal, choice.depth, &joint);
    const ox_plane_choice together = ox_leave_jointly(r, &seed, &joint, &known);
    if (ox_is_better_choice(&together, &known)) known = together;
    const float of_both = ox_max(choice.depth, ox_depth_of_both(r, choice.plane.normal));
    choice.judged = ox_cost_of(r, before, &choice.plane, of_both);
    if (ox_is_better_choice(&choice, &known)) known = choice;
  }
  if (seed.refused.count < OX_FEW) return known;
  ox_plane_choice own = known;
  const ox_plane plane = ox_own_plane(r, unit);
  ox_try_unit(r, &seed, &plane, &own);
  const float allowed = ox_taken_back(before, known.plane.normal, known.depth) +
                        OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  return ox_is_better_choice(&own, &known) &&
                 ox_taken_back(before, own.plane.normal, own.depth) <= allowed &&
                 !ox_unit_stays(r, &seed, &own)
             ? own
             : known;
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

// Adds those that a plane clears by a move so far along it.
static inline void ox_add_cleared_by(const ox_unit_block* units, const ox_plane* plane, float along,
                                     float past, ox_ints* cleared) {
  const float3 n = plane->normal;
  const ox_floats one =
      units->position[0] * n.x + units->position[1] * n.y + units->position[2] * n.z;
  const ox_floats other = units->end[0] * n.x + units->end[1] * n.y + units->end[2] * n.z;
  for (uint side = 0u; side < 2u; ++side) {
    if (!ox_clears_side(plane, side)) continue;
    const ox_floats a = plane->level[side] + (side == 0u ? -one : one);
    const ox_floats b = plane->level[side] + (side == 0u ? -other : other);
    const ox_ints clears = (a + b >= past + past) & (a <= along) & (b <= along);
    *cleared |= clears & (side == 0u ? ~units->is_b : units->is_b);
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
