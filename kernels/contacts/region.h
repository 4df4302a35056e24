// SPDX-License-Identifier: BSD-3-Clause
// A region of overlap and what a plane costs it. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_REGION_H
#define ODE_EXT_KERNELS_CONTACTS_REGION_H

#include "contacts/region_fields.h"

typedef struct {
  const ox_scene* scene;
  uint index;
  uint pair;
  uint count;
  uint flags;
  uint plane_count;
  ox_fields members;
  __global const ox_face* faces;
  ox_fields planes;
} ox_region_view;

static inline float3 ox_position_of(const ox_region_view* r, uint k) {
  return ox_vector_of(&r->members, OX_MEMBER_POSITION, k);
}

// Of a chord; of a vertex inside its position.
static inline float3 ox_middle_of(const ox_region_view* r, uint k) {
  return 0.5f * (ox_position_of(r, k) + ox_vector_of(&r->members, OX_MEMBER_END, k));
}

static inline uint ox_flags_of(const ox_region_view* r, uint k) {
  return ox_words_of(&r->members, OX_MEMBER_FLAGS)[k];
}

static inline __global const ox_feature* ox_feature_of(const ox_region_view* r, uint k) {
  return r->scene->features + ox_words_of(&r->members, OX_MEMBER_FEATURE)[k];
}

// The first of one so far, or OX_NONE, and of some of a block of the members.
static inline uint ox_first_of(const ox_region_view* r, uint block, uint lanes, uint best) {
  for (; lanes != 0u; lanes &= lanes - 1u) {
    const uint k = OX_VECTOR_WIDTH * block + ox_lowest(lanes);
    if (best == OX_NONE || ox_is_before(ox_feature_of(r, k), ox_feature_of(r, best))) best = k;
  }
  return best;
}

// Of a block of the members those that are vertices of mesh 1 - `side`, all that are no points of
// mesh `side`: crossings are of both.
static inline void ox_others_of_block(const ox_region_view* r, uint block, uint side,
                                      ox_ints* is_other) {
  const int others = (int)(OX_FEATURE_VERTEX | (side == 0u ? OX_FEATURE_SIDE : 0u));
  const int mask = (int)(OX_FEATURE_VERTEX | OX_FEATURE_SIDE);
  *is_other = (OX_LOAD_WORDS(&r->members, OX_MEMBER_FLAGS, block) & mask) == others;
}

// The way into its own mesh at a vertex.
static inline float3 ox_inward_at(const ox_region_view* r, __global const ox_feature* f) {
  const float3 inward = vload3(0, r->scene->vertices[f->source].direction);
  return ox_side_of(f->flags) == 1u ? inward : ox_rotate(r->scene->pairs + r->pair, 0u, inward);
}

// Of a normal and those of the faces at an edge of mesh `side` the one that faces back from a
// direction the most.
static inline float3 ox_back_of_edge(const ox_region_view* r, uint side, uint edge,
                                     float3 direction, float3 back) {
  for (uint k = 0u; k < 2u; ++k) {
    const uint triangle = r->scene->edges[edge].triangle[k];
    if (triangle == OX_NONE) continue;
    const float3 normal = ox_normal_of(r->scene, r->pair, side, triangle);
    if (ox_dot(direction, normal) < ox_dot(direction, back)) back = normal;
  }
  return back;
}

// The same of the faces at a vertex.
static inline float3 ox_back_of_vertex(const ox_region_view* r, uint side, uint vertex,
                                       float3 direction) {
  const ox_scene* scene = r->scene;
  float3 back = direction;
  for (uint i = scene->ring_starts[vertex]; i < scene->ring_starts[vertex + 1u]; ++i)
    back = ox_back_of_edge(r, side, scene->rings[i].edge, direction, back);
  return back;
}

static inline bool ox_looks_back(float3 normal, float3 direction) {
  return ox_dot(normal, direction) < OX_LOOKS_BACK;
}

// Of two planes that are as deep the one that the body does not go on through is better [m].
static inline float ox_body_tie(const ox_region_view* r) {
  return OX_MARGIN * r->scene->pairs[r->pair].epsilon;
}

// How deep all of mesh `side` is below a plane, and the tie [m]; or something beyond `limit`.
static inline float ox_measure_body(const ox_region_view* r, const ox_plane* plane, uint side,
                                    float limit) {
  const float3 down = -ox_way_of(side, plane->normal);
  const float level = plane->level[side];
  // Where the walk ends early, the tie is more than rounding and takes the sum past the limit.
  return level + ox_reach_along(r->scene, r->pair, side, down, limit - level) + ox_body_tie(r);
}

// The same. What is found of a face of the region is kept, since many units ask; of a pair of edges
// it would be of either side.
static inline float ox_depth_of_body(const ox_region_view* r, const ox_plane* plane, uint side,
                                     float limit) {
  if (plane->index == OX_NONE || plane->kind == OX_PLANE_EDGES)
    return ox_measure_body(r, plane, side, limit);
  __global float* kept = ox_floats_of(&r->planes, OX_PLANE_OF_BODY) + plane->index;
  __global uint* flags = ox_words_of(&r->planes, OX_PLANE_FLAGS) + plane->index;
  const float known = *kept;
  if (known > limit || (*flags & OX_PLANE_MEASURED) != 0u) return known;
  const float depth = ox_measure_body(r, plane, side, limit);
  ox_settle();
  *kept = depth;  // each of a group the same
  if (depth <= limit) *flags |= OX_PLANE_MEASURED;
  ox_settle();
  return depth;
}

// How far A has to go along a direction to be past all of B [m].
static inline float ox_depth_of_both(const ox_region_view* r, float3 normal) {
  return ox_reach_along(r->scene, r->pair, 0u, -normal, INFINITY) +
         ox_reach_along(r->scene, r->pair, 1u, normal, INFINITY);
}

// Whether the members of a region are points of mesh `side`: crossings are of both.
static inline bool ox_is_on(uint flags, uint side) {
  return !ox_is_vertex(flags) || ox_side_of(flags) == side;
}

// A plane and its price.
typedef struct {
  ox_plane plane;
  float depth;       // [m] how far to move
  float judged;      // what it is compared by
  bool of_body;      // that is for a body that goes on beyond the region
  bool all_of_body;  // all of it has to move, more than twice as far as the region alone
} ox_plane_choice;

static inline ox_plane_choice ox_no_choice(void) {
  ox_plane_choice choice;
  choice.plane = ox_no_plane();
  choice.depth = choice.judged = INFINITY;
  choice.of_body = choice.all_of_body = false;
  return choice;
}

// A total order, so that it does not matter which comes first.
static inline bool ox_is_better_choice(const ox_plane_choice* a, const ox_plane_choice* b) {
  if (a->judged != b->judged) return a->judged < b->judged;
  if (a->plane.kind != b->plane.kind) return a->plane.kind > b->plane.kind;
  if (a->plane.id[0] != b->plane.id[0]) return a->plane.id[0] < b->plane.id[0];
  return a->plane.id[1] < b->plane.id[1];
}

#endif
