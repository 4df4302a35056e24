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

// How far the moves before take what a plane clears along it, at most [m].
static inline float ox_gone_along(const ox_moves* moves, float3 normal) {
  float most = 0.0f;
  for (uint i = 0u; i < moves->count; ++i)
    most = ox_max(most, moves->far[i] * ox_dot(moves->chosen[i].normal, normal));
  return most;
}

// What a plane costs a unit that has to go so far: what is left of that after the moves before.
static inline float ox_cost_of(const ox_region_view* r, const ox_moves* moves,
                               const ox_plane* plane, float depth) {
  const float left = ox_max(depth - ox_gone_along(moves, plane->normal), 0.0f);
  return left + ox_edge_tie(r, plane) + ox_taken_back(moves, plane->normal, depth);
}

#endif
