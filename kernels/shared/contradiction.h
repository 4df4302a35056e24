// SPDX-License-Identifier: BSD-3-Clause
// Which of two candidates comes first, and which cannot both stand. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_CONTRADICTION_H
#define ODE_EXT_KERNELS_SHARED_CONTRADICTION_H

#include "shared/transform.h"

static inline uint ox_kind(__global const ox_candidate* c) { return c->side_kind & OX_HIT_KIND; }

// By side and place; by the order of the vertices, which for a deformed mesh tells of the shape it
// was built in, only where rounding has put two in one place. Points come after vertices: what
// their `vertex` counts are triangles, and an index of one kind against one of another tells only
// how many other meshes there are.
static inline bool ox_key_less(__global const ox_candidate* a, __global const ox_candidate* b) {
  const uint side_a = a->side_kind & OX_HIT_SIDE;
  const uint side_b = b->side_kind & OX_HIT_SIDE;
  if (side_a != side_b) return side_a < side_b;
  for (uint k = 0u; k < 3u; ++k)
    if (a->position[k] != b->position[k]) return a->position[k] < b->position[k];
  const uint point_a = a->side_kind & OX_HIT_POINT;
  const uint point_b = b->side_kind & OX_HIT_POINT;
  if (point_a != point_b) return point_a < point_b;
  if (a->vertex != b->vertex) return a->vertex < b->vertex;
  return a->triangle < b->triangle;
}

static inline bool ox_deeper(__global const ox_candidate* a, __global const ox_candidate* b) {
  return a->depth != b->depth ? a->depth > b->depth : ox_key_less(a, b);
}

// Two contacts contradict one another if they push opposite ways and a way out by one of them leads
// deeper into the other: what lies between their places along the normal is not more than their
// depth, to within rounding: where boxes in line are half inside one another, and in equal bodies
// in one place, it is the same length. (A peg between two walls has opposite contacts too, but as
// far apart as it is thick.) The shorter way out stands. Equal bodies in one place have as many
// ways out as faces; then the order decides.
static inline bool ox_contradicts(__global const ox_candidate* a, __global const ox_candidate* b,
                                  float epsilon) {
  const float3 normal = vload3(0, a->normal);
  if (ox_dot(normal, vload3(0, b->normal)) > -0.5f) return false;
  const float apart = ox_dot(vload3(0, a->position) - vload3(0, b->position), normal);
  return fabs(apart) <= ox_max(a->depth, b->depth) + epsilon;
}

#endif
#endif
