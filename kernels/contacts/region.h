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

// Of a block of the members those that are vertices of mesh 1 - `side`, all that are no points of
// mesh `side`: crossings are of both.
static inline void ox_others_of_block(const ox_region_view* r, uint block, uint side,
                                      ox_ints* is_other) {
  const int others = (int)(OX_FEATURE_VERTEX | (side == 0u ? OX_FEATURE_SIDE : 0u));
  const int mask = (int)(OX_FEATURE_VERTEX | OX_FEATURE_SIDE);
  *is_other = (OX_LOAD_WORDS(&r->members, OX_MEMBER_FLAGS, block) & mask) == others;
}

// Whether one of the faces at a vertex of mesh `side` faces back from a direction.
static inline bool ox_vertex_looks_back(const ox_region_view* r, uint side, uint vertex,
                                        float3 direction) {
  const ox_scene* scene = r->scene;
  for (uint i = scene->ring_starts[vertex]; i < scene->ring_starts[vertex + 1u]; ++i) {
    __global const ox_edge* edge = scene->edges + scene->rings[i].edge;
    for (uint k = 0u; k < 2u; ++k)
      if (edge->triangle[k] != OX_NONE &&
          ox_dot(direction, ox_normal_of(scene, r->pair, side, edge->triangle[k])) < OX_LOOKS_BACK)
        return true;
  }
  return false;
}

// Whether mesh `side`, which the plane clears, goes on through a face of the other that looks back:
// one that crosses it, or at a vertex inside it. Then it is not only what of it is in the region
// that has to pass the plane. (The plane of a face of A has the face's normal turned.)
static inline bool ox_body_goes_on(const ox_region_view* r, const ox_plane* plane, uint side) {
  if ((r->flags & OX_REGION_CROSSED) == 0u) return false;  // one is inside the other
  for (uint block = 0u; OX_VECTOR_WIDTH * block < r->plane_count; ++block) {
    const uint through =
        ox_of_kind(&r->planes, block, OX_PLANE_KIND | OX_PLANE_CROSSED,
                   OX_PLANE_CROSSED | (side == 0u ? OX_PLANE_FACE_OF_B : OX_PLANE_FACE_OF_A));
    ox_floats cosine;
    ox_dot_fields(&r->planes, OX_PLANE_NORMAL, block, plane->normal, &cosine);
    const ox_ints looks_back = cosine < OX_LOOKS_BACK;
    if ((ox_mask_of(&looks_back) & through & ox_present_lanes(r->plane_count, block)) != 0u)
      return true;
  }
  const float3 direction = ox_way_of(side, plane->normal);
  for (uint first = 0u; first < r->count; first += OX_ITEMS) {
    const uint k = first + OX_ITEM;
    const uint flags = k < r->count ? ox_flags_of(r, k) : 0u;
    if (ox_any_item(ox_is_vertex(flags) && ox_side_of(flags) != side &&
                    ox_vertex_looks_back(r, 1u - side, ox_feature_of(r, k)->source, direction)))
      return true;
  }
  return false;
}

// Of two planes that are as deep the one that the body does not go on through is better [m].
static inline float ox_body_tie(const ox_region_view* r) {
  return OX_MARGIN * r->scene->pairs[r->pair].epsilon;
}

// How deep all of mesh `side` is below a plane, and the tie [m]; or something beyond `limit`.
static inline float ox_depth_of_body(const ox_region_view* r, const ox_plane* plane, uint side,
                                     float limit) {
  const float3 down = -ox_way_of(side, plane->normal);
  const float level = plane->level[side];
  // Where the walk ends early, the tie is more than rounding and takes the sum past the limit.
  return level + ox_reach_along(r->scene, r->pair, side, down, limit - level) + ox_body_tie(r);
}

// How far A has to go along a direction to be past all of B [m].
static inline float ox_depth_of_both(const ox_region_view* r, float3 normal) {
  return ox_reach_along(r->scene, r->pair, 0u, -normal, INFINITY) +
         ox_reach_along(r->scene, r->pair, 1u, normal, INFINITY);
}

// How deep the bodies are that go on beyond the region; 0 if neither does.
static inline float ox_depth_beyond(const ox_region_view* r, const ox_plane* plane, float limit) {
  float depth = 0.0f;
  for (uint side = 0u; side < 2u && !(depth > limit); ++side)
    if (ox_clears_side(plane, side) && ox_body_goes_on(r, plane, side))
      depth = ox_max(depth, ox_depth_of_body(r, plane, side, limit));
  return depth;
}

// Whether the members of a region are points of mesh `side`: crossings are of both.
static inline bool ox_is_on(uint flags, uint side) {
  return !ox_is_vertex(flags) || ox_side_of(flags) == side;
}

// A plane and its price.
typedef struct {
  ox_plane plane;
  float depth;   // [m] how far to move
  float judged;  // what it is compared by
  bool of_body;  // that is what it takes to move all of a body that goes on beyond the region
} ox_plane_choice;

static inline ox_plane_choice ox_no_choice(void) {
  ox_plane_choice choice;
  choice.plane = ox_no_plane();
  choice.depth = choice.judged = INFINITY;
  choice.of_body = false;
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
