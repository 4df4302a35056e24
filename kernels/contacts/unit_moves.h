// SPDX-License-Identifier: BSD-3-Clause
// The planes by which a region in units is cleared one after the other, and what one more costs
// beside them. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_UNIT_MOVES_H
#define ODE_EXT_KERNELS_CONTACTS_UNIT_MOVES_H

#include "contacts/units.h"

// The planes chosen so far, and the moves along their normals.
typedef struct {
  uint count;
  ox_plane chosen[OX_MOST_PLANES];
  // What lies on the plane, as a triangle of the body that is moved past it; OX_NONE: no face does.
  uint face[OX_MOST_PLANES];
  float far[OX_MOST_PLANES];    // [m] how far each goes
  float along[OX_MOST_PLANES];  // [m] how far the last goes along each
  float lent[OX_MOST_PLANES];   // [m] as much of it as its unit proposed to go itself
  float3 at[OX_MOST_PLANES];    // the middle of the unit that each was chosen for
} ox_moves;

// Takes the face of a body that looks the most against the way that a plane moves it.
static inline void ox_try_face_on(const ox_region_view* r, uint side, __global const uint* faces,
                                  const ox_plane* plane, float* most, uint* best) {
  const float3 back = -ox_way_of(side, plane->normal);
  for (uint k = 0u; k < 2u; ++k) {
    if (faces[k] == OX_NONE) continue;
    const float cosine = ox_dot(ox_normal_of(r->scene, r->pair, side, faces[k]), back);
    if (!(cosine > *most) && !(cosine == *most && faces[k] < *best)) continue;
    *best = faces[k];
    *most = cosine;
  }
}

// The face by which a unit lies on a plane that it is moved past; OX_NONE: there is none.
static inline uint ox_face_on(const ox_region_view* r, uint unit, const ox_plane* plane) {
  const ox_scene* scene = r->scene;
  uint best = OX_NONE;
  float most = OX_SAME_WAY;
  const uint side = ox_side_of(ox_flags_of(r, unit));
  if (plane->kind == OX_PLANE_EDGES || !ox_clears_side(plane, side)) return best;
  uint feature = ox_words_of(&r->members, OX_MEMBER_FEATURE)[unit];
  for (uint end = 0u; end < 2u && feature != OX_NONE; ++end) {
    __global const ox_feature* f = scene->features + feature;
    feature = f->partner;
    if (!ox_is_vertex(f->flags)) {
      ox_try_face_on(r, side, f->at, plane, &most, &best);
      continue;
    }
    for (uint i = scene->ring_starts[f->source]; i < scene->ring_starts[f->source + 1u]; ++i)
      ox_try_face_on(r, side, scene->edges[scene->rings[i].edge].triangle, plane, &most, &best);
    break;
  }
  return best;
}

static inline void ox_add_move(const ox_region_view* r, const ox_plane_choice* choice, uint unit,
                               ox_moves* moves) {
  const uint last = moves->count++;
  const float far = choice->depth + OX_INFLATION * r->scene->pairs[r->pair].epsilon;
  moves->chosen[last] = choice->plane;
  moves->face[last] = ox_face_on(r, unit, &choice->plane);
  moves->at[last] = ox_middle_of(r, unit);
  moves->far[last] = moves->along[last] = far;
  moves->lent[last] = ox_min(far, ox_floats_of(&r->members, OX_MEMBER_LEAST)[unit]);
  for (uint i = 0u; i < last; ++i)
    moves->along[i] = far * ox_dot(choice->plane.normal, moves->chosen[i].normal);
}

// The first of the moves past a plane, which is one of theirs: what all of them clear is of one
// manifold.
static inline uint ox_first_past(const ox_moves* moves, const ox_plane* plane) {
  uint i = 0u;
  while (!ox_is_same_plane(moves->chosen + i, plane)) ++i;
  return i;
}

// The plane of the face that lies on that of a move; OX_PLANE_NONE: there is none.
static inline ox_plane ox_plane_on(const ox_region_view* r, const ox_moves* moves, uint i) {
  if (moves->face[i] == OX_NONE) return ox_no_plane();
  const uint side = moves->chosen[i].kind == OX_PLANE_FACE_OF_A ? 1u : 0u;
  return ox_plane_of_face(r->scene, r->pair, side, moves->face[i]);
}

// How much of a move before it a move of `depth` along a normal takes back, at most [m]. That is
// added to what a plane costs: two that oppose one another jam the body between them.
static inline float ox_taken_back(const ox_moves* moves, float3 normal, float depth) {
  float most = 0.0f;
  for (uint i = 0u; i < moves->count; ++i)
    most = ox_max(most, -ox_min(moves->far[i], depth) * ox_dot(moves->chosen[i].normal, normal));
  return most;
}

// Of the moves before the one that takes what a plane clears the farthest along it, *along [m];
// OX_NONE: none does. None lends more than its unit proposed to go itself: of a ring on a plate,
// across its edge, one vertex would lead the next out past the plate's side else, each a little
// farther.
static inline uint ox_leading_move(const ox_moves* moves, float3 normal, float* along) {
  uint leading = OX_NONE;
  *along = 0.0f;
  for (uint i = 0u; i < moves->count; ++i) {
    const float lent = moves->lent[i] * ox_dot(moves->chosen[i].normal, normal);
    if (!(lent > *along)) continue;
    *along = lent;
    leading = i;
  }
  return leading;
}

// How far that is, at most [m].
static inline float ox_gone_along(const ox_moves* moves, float3 normal) {
  float along;
  ox_leading_move(moves, normal, &along);
  return along;
}

// And how far the same move takes it across the normal, the way A is moved [m].
static inline float3 ox_gone_aside(const ox_moves* moves, float3 normal) {
  float along;
  const uint leading = ox_leading_move(moves, normal, &along);
  if (leading == OX_NONE) return (float3)(0.0f);
  return moves->lent[leading] * moves->chosen[leading].normal - along * normal;
}

// Of planes that cost as much, to within what is not known, one that goes the way of a move before
// is better: past it nothing goes another way. (Where a box slides along the foot of a wall, a
// vertex of that foot is at the box's front for a moment, as deep below the front as not at all;
// by the move out of the floor it comes out past the box's lower side as well.) [m]
static inline float ox_other_way_tie(const ox_region_view* r, const ox_moves* moves,
                                     float3 normal) {
  float cosine = 0.0f;
  for (uint i = 0u; i < moves->count; ++i)
    cosine = ox_max(cosine, ox_dot(moves->chosen[i].normal, normal));
  // Rounding takes the cosine past 1. What a plane costs must be no less than what it is looked for
  // by (ox_clearing_planes): of two of one plane the first to be looked at would be taken.
  return ox_max(1.0f - cosine, 0.0f) * OX_MARGIN * r->scene->pairs[r->pair].epsilon;
}

// What a plane costs a unit that has to go so far: what is left of that after the moves before.
static inline float ox_cost_of(const ox_region_view* r, const ox_moves* moves,
                               const ox_plane* plane, float depth) {
  const float left = ox_max(depth - ox_gone_along(moves, plane->normal), 0.0f);
  return left + ox_edge_tie(r, plane) + ox_other_way_tie(r, moves, plane->normal) +
         ox_taken_back(moves, plane->normal, depth);
}

#endif
