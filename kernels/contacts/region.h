// SPDX-License-Identifier: BSD-3-Clause
// A region of overlap and what a plane costs it. Device only.
#ifdef OX_PLANES
#ifndef ODE_EXT_KERNELS_CONTACTS_REGION_H
#define ODE_EXT_KERNELS_CONTACTS_REGION_H

#include "contacts/face_table.h"
#include "contacts/plane.h"

typedef struct {
  const ox_scene* scene;
  uint index;
  uint pair;
  uint count;
  uint flags;
  uint plane_count;
  __global const ox_feature* features;
  __global ox_member* members;
  __global const ox_face* faces;
  __global ox_plane_record* planes;
} ox_region_view;

// A face that looks back from a plane by more than this is one through which the body goes on.
#define OX_LOOKS_BACK -0.1f
// A pair of edges holds a body at one point, a face at more. Where both are as deep, as where a box
// rests on a face, rounding is not to choose the pair: it has to be better by so much, in epsilons,
// which is what the growth of A and rounding may make of either depth.
#define OX_EDGE_TIE (4.0f * OX_INFLATION)

static inline ox_plane ox_load_plane(__global const ox_plane_record* record) {
  ox_plane plane;
  plane.kind = record->kind & ~OX_PLANE_CROSSED;
  plane.id[0] = record->id[0];
  plane.id[1] = record->id[1];
  plane.normal = vload3(0, record->normal);
  plane.top = record->top;
  plane.bottom = record->bottom;
  return plane;
}

// Whether mesh `side`, which the plane clears, goes on through a face of the other that looks back:
// then it is not only what of it is in the region that has to pass the plane. (The plane of a face
// of A has the face's normal turned.)
static inline bool ox_body_goes_on(const ox_region_view* r, const ox_plane* plane, uint side) {
  const uint through = OX_PLANE_CROSSED | (side == 0u ? OX_PLANE_FACE_OF_B : OX_PLANE_FACE_OF_A);
  for (uint i = 0u; i < r->plane_count; ++i)
    if (r->planes[i].kind == through &&
        ox_dot(plane->normal, vload3(0, r->planes[i].normal)) < OX_LOOKS_BACK)
      return true;
  return false;
}

// How deep all of the bodies are below a plane, if they go on beyond the region [m]; else 0.
static inline float ox_depth_beyond(const ox_region_view* r, const ox_plane* plane) {
  float depth = 0.0f;
  for (uint side = 0u; side < 2u; ++side) {
    if (!ox_clears_side(plane, side) || !ox_body_goes_on(r, plane, side)) continue;
    const float3 down = side == 0u ? -plane->normal : plane->normal;
    const float reach = ox_reach_along(r->scene, r->pair, side, down);
    const float of_side = side == 0u ? plane->top + reach : reach - plane->bottom;
    // Of two that are as deep the one that it does not go on through is better.
    depth = ox_max(depth, of_side + 4.0f * r->scene->pairs[r->pair].epsilon);
  }
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
} ox_plane_choice;

static inline ox_plane_choice ox_no_choice(void) {
  ox_plane_choice choice;
  choice.plane = ox_no_plane();
  choice.depth = choice.judged = INFINITY;
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
#endif
