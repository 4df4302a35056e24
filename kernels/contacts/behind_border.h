// SPDX-License-Identifier: BSD-3-Clause
// How far a solid reaches behind an open mesh below the border of that. Device only.
//
// What is moved past a face of an open mesh is all of the solid that is behind the mesh. Beside a
// solid its edges would cross the sides of that; an open mesh has none. That the body goes on
// behind it, and how far, is told by the border alone, where that is inside the body. Else a body
// that comes to a ledge from the side would be up already, and one that tilts over it as well.
#ifndef ODE_EXT_KERNELS_CONTACTS_BEHIND_BORDER_H
#define ODE_EXT_KERNELS_CONTACTS_BEHIND_BORDER_H

#include "contacts/ways.h"

// Whether a feature is of the border of its mesh.
static inline bool ox_is_of_border(const ox_scene* scene, __global const ox_feature* f) {
  if (!ox_is_vertex(f->flags)) return ox_is_border(scene, f->source);
  for (uint i = scene->ring_starts[f->source]; i < scene->ring_starts[f->source + 1u]; ++i)
    if (ox_is_border(scene, scene->rings[i].edge)) return true;
  return false;
}

static inline bool ox_is_open_side(const ox_region_view* r, uint side) {
  return (ox_target_of(r, 1u - side)->flags & OX_MESH_CLOSED) == 0u;
}

// Whether a plane is a face of an open mesh, and the border of that crosses the solid that is moved
// past it.
static inline bool ox_has_border(const ox_region_view* r, const ox_plane* plane) {
  const uint of = plane->kind == OX_PLANE_FACE_OF_A ? 0u : 1u;
  return plane->kind != OX_PLANE_EDGES && ox_is_open_side(r, of) && !ox_is_open_side(r, 1u - of) &&
         r->scene->found[r->pair].at_border[of] != 0u;
}

// A point of the border, and what of the solid is below it.
typedef struct {
  float3 position;
  float depth;    // [m]
  uint triangle;  // of the solid, by which it ends there; OX_NONE: the point is not inside
} ox_behind;

// [m] how deep the solid is along a direction, to the plane of a face that it leaves by.
static inline float ox_depth_to(uint of, float3 p, float3 direction, const ox_plane* face) {
  return ox_plane_depth(face, of, p) / ox_dot(ox_way_of(of, face->normal), direction);
}

// The face by which a direction leaves the solid; OX_PLANE_NONE: none is known.
static inline ox_plane ox_face_behind(const ox_region_view* r, uint of, float3 p,
                                      float3 direction) {
  const ox_plane face = ox_face_along(r, of, p, direction);
  return ox_dot(ox_way_of(of, face.normal), direction) > 0.0f ? face : ox_no_plane();
}

// A stretch of the border inside the solid, and the faces that are below its ends.
typedef struct {
  float3 from, to;
  ox_plane below[2];
} ox_border_stretch;

// Where below a stretch the solid is the deepest. Of a convex one the planes of its faces bound how
// deep it is: where those of the two ends meet it is asked, and what is found takes the place of
// the one that bounds it on the same side (Kelley's cutting planes).
static inline ox_behind ox_deepest_of_stretch(const ox_region_view* r, uint of, float3 direction,
                                              ox_border_stretch* s) {
  ox_behind deepest = {s->from, -INFINITY, OX_NONE};
  for (uint round = 0u; round < OX_FEW; ++round) {
    float at[2], rise[2];
    for (uint k = 0u; k < 2u; ++k) {
      at[k] = ox_depth_to(of, s->from, direction, &s->below[k]);
      rise[k] = ox_depth_to(of, s->to, direction, &s->below[k]) - at[k];
    }
    const float part = (at[1] - at[0]) / (rise[0] - rise[1]);
    if (!(part > 0.0f && part < 1.0f)) break;
    const float3 p = s->from + part * (s->to - s->from);
    const ox_plane face = ox_face_behind(r, of, p, direction);
    if (face.kind == OX_PLANE_NONE) break;
    const float depth = ox_max(ox_depth_to(of, p, direction, &face), 0.0f);
    if (depth > deepest.depth) {
      deepest.position = p;
      deepest.depth = depth;
      deepest.triangle = face.id[0];
    }
    if (face.id[0] == s->below[0].id[0] || face.id[0] == s->below[1].id[0]) break;
    const bool rises = ox_depth_to(of, s->to, direction, &face) > depth;
    s->below[rises ? 0u : 1u] = face;
  }
  return deepest;
}

// [epsilon] So far along an edge that meets a side at a quarter of a degree it is one inside.
#define OX_INSIDE_ALONG 256.0f

// From an end of a chord a little towards the other.
static inline float3 ox_a_little_on(const ox_region_view* r, float3 from, float3 to) {
  const float inside = OX_INSIDE_ALONG * r->scene->pairs[r->pair].epsilon;
  const float3 d = to - from;
  return from + ox_min(inside / sqrt(ox_dot(d, d)), 0.5f) * d;
}

// Looks below the stretch from a feature of the border to another point for what is deeper than
// `deepest`.
static inline void ox_look_behind(const ox_region_view* r, uint of, float3 direction, float3 from,
                                  const ox_plane* below, float3 to, float3 asked,
                                  ox_behind* deepest) {
  ox_border_stretch stretch;
  stretch.from = from;
  stretch.to = to;
  stretch.below[0] = *below;
  stretch.below[1] = ox_face_behind(r, of, asked, direction);
  if (stretch.below[1].kind == OX_PLANE_NONE) return;
  const ox_behind found = ox_deepest_of_stretch(r, of, direction, &stretch);
  if (found.depth > deepest->depth) *deepest = found;
}

// Points below a feature, if it is of the border of the mesh of a plane, no more than there is room
// for candidates: below itself, and the deepest of the stretches that begin at it. Returns how
// many.
#define OX_BEHIND_FEATURE OX_CANDIDATES_PER_FEATURE
static inline uint ox_find_behind_border(const ox_region_view* r, uint k, const ox_plane* plane,
                                         ox_behind* at) {
  const ox_scene* scene = r->scene;
  const uint of = plane->kind == OX_PLANE_FACE_OF_A ? 0u : 1u;
  const float3 down = -ox_way_of(1u - of, plane->normal);
  __global const ox_feature* f = ox_feature_of(r, k);
  if (ox_side_of(f->flags) != of || !ox_is_of_border(scene, f)) return 0u;
  const bool is_vertex = ox_is_vertex(f->flags);
  if (!is_vertex && f->partner == OX_NONE) return 0u;
  const float3 position = vload3(0, f->position);
  const uint partner = is_vertex ? OX_NONE : f->partner;
  const float3 end = partner == OX_NONE ? position : vload3(0, scene->features[partner].position);
  const float3 asked = is_vertex ? position : ox_a_little_on(r, position, end);
  const ox_plane below = ox_face_behind(r, of, asked, down);
  if (below.kind == OX_PLANE_NONE) return 0u;
  at[0].position = position;
  at[0].depth = ox_max(ox_depth_to(of, position, down, &below), 0.0f);
  at[0].triangle = below.id[0];
  at[1].depth = -INFINITY;
  if (!is_vertex) {
    const bool to_vertex = ox_is_vertex(scene->features[partner].flags);
    if ((f->flags & OX_FEATURE_LEAVES) != 0u && !to_vertex) return 1u;  // it ends here
    ox_look_behind(r, of, down, position, &below, end,
                   to_vertex ? end : ox_a_little_on(r, end, position), &at[1]);
  } else {
    for (uint i = scene->ring_starts[f->source]; i < scene->ring_starts[f->source + 1u]; ++i) {
      const uint edge = scene->rings[i].edge;
      if (!ox_is_border(scene, edge) || scene->edges[edge].vertex[0] != f->source) continue;
      const float3 to = ox_vertex_of(scene, r->pair, of, scene->edges[edge].vertex[1]);
      ox_look_behind(r, of, down, position, &below, to, to, &at[1]);
    }
  }
  return at[1].depth == -INFINITY ? 1u : 2u;
}

// How far the solid reaches along the way down from a plane, of which ox_has_border, from the base
// on [m]; or something beyond `limit`.
static inline float ox_reach_behind_border(const ox_region_view* r, const ox_plane* plane,
                                           float limit) {
  const uint side = plane->kind == OX_PLANE_FACE_OF_A ? 1u : 0u;
  const float3 down = -ox_way_of(side, plane->normal);
  float reach = -INFINITY;
  for (uint k = 0u; k < r->count && !(reach > limit); ++k) {
    ox_behind at[OX_BEHIND_FEATURE];
    const uint count = ox_find_behind_border(r, k, plane, at);
    for (uint i = 0u; i < count; ++i)
      reach = ox_max(reach, ox_dot(down, at[i].position) + at[i].depth);
  }
  return reach;
}

#endif
