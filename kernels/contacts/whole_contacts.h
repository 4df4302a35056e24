// SPDX-License-Identifier: BSD-3-Clause
// Contacts of a region that one plane separates. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_WHOLE_CONTACTS_H
#define ODE_EXT_KERNELS_CONTACTS_WHOLE_CONTACTS_H

#include "contacts/candidates.h"

// Whether a feature is of the border of its mesh, which is open: of one of its edges, or where it
// turns.
static inline bool ox_is_of_border(const ox_region_view* r, __global const ox_feature* f) {
  const ox_scene* scene = r->scene;
  if (!ox_is_vertex(f->flags)) return scene->edges[f->source].triangle[1] == OX_NONE;
  float3 sum = (float3)(0.0f);  // of the directions of the border there
  bool any = false;
  for (uint i = scene->ring_starts[f->source]; i < scene->ring_starts[f->source + 1u]; ++i) {
    __global const ox_edge* edge = scene->edges + scene->rings[i].edge;
    if (edge->triangle[1] != OX_NONE) continue;
    const uint other = edge->vertex[edge->vertex[0] == f->source ? 1u : 0u];
    const float3 d =
        vload3(0, scene->vertices[other].position) - vload3(0, scene->vertices[f->source].position);
    sum += d / sqrt(ox_dot(d, d));
    any = true;
  }
  return any && ox_dot(sum, sum) > OX_FACET_ANGLE * OX_FACET_ANGLE;
}

// [epsilon] So far along an edge that meets a side at a quarter of a degree it is one inside.
#define OX_INSIDE_ALONG 256.0f

// How deep the other mesh is along a direction [m], from a point of mesh `side` to a face that it
// leaves by; infinite where there is none.
static inline float ox_depth_to(uint side, float3 p, float3 direction, const ox_plane* face) {
  const float cosine = ox_dot(ox_way_of(side, face->normal), direction);
  return face->kind == OX_PLANE_NONE || !(cosine > 0.0f)
             ? INFINITY
             : ox_max(ox_plane_depth(face, side, p) / cosine, 0.0f);
}

// Where mesh `side` hangs over the border of an open mesh, a face of which it is moved past, and
// has its own face below, nearer than what is above: as deep as that is there. Of a solid an edge
// of its own would cross the side.
static inline void ox_add_border(const ox_manifold* m, const ox_plane_choice* choice, uint side) {
  const ox_region_view* r = m->region;
  const float3 down = -ox_way_of(side, choice->plane.normal);
  for (uint k = 0u; k < r->count; ++k) {
    __global const ox_feature* f = ox_feature_of(r, k);
    if (ox_side_of(f->flags) == side || f->triangle == OX_NONE || !ox_is_of_border(r, f)) continue;
    const float3 position = vload3(0, f->position);
    float3 asked = position;
    if (!ox_is_vertex(f->flags)) {
      if (f->partner == OX_NONE) continue;
      // Where it is inside, or midway along the chord.
      const float3 d = vload3(0, r->scene->features[f->partner].position) - position;
      const float inside = OX_INSIDE_ALONG * r->scene->pairs[r->pair].epsilon;
      asked += ox_min(inside / sqrt(ox_dot(d, d)), 0.5f) * d;
    }
    const ox_plane below = ox_face_along(r, 1u - side, asked, down);
    const ox_plane above = ox_face_along(r, 1u - side, asked, -down);
    const float depth = ox_depth_to(1u - side, position, down, &below);
    const bool looks_down = ox_dot(ox_way_of(1u - side, below.normal), down) > OX_SAME_WAY;
    if (depth == INFINITY || !looks_down || !ox_is_first_item() ||
        depth > ox_depth_to(1u - side, position, -down, &above))
      continue;
    ox_add_candidate(m, choice, side, position, depth, OX_HIT_POINT, f->triangle,
                     choice->plane.id[0], ox_touch_of(f, f->triangle));
  }
}

// Contacts of a region.
static inline void ox_add_whole(const ox_manifold* m, const ox_plane_choice* choice) {
  const ox_region_view* r = m->region;
  if (choice->plane.kind == OX_PLANE_NONE) return;
  if (choice->plane.kind == OX_PLANE_EDGES) {
    ox_add_edge_contact(m, choice);
    return;
  }
  const uint side = choice->plane.kind == OX_PLANE_FACE_OF_A ? 1u : 0u;
  const bool has_border = (ox_target_of(r, side)->flags & OX_MESH_CLOSED) == 0u &&
                          (ox_target_of(r, 1u - side)->flags & OX_MESH_CLOSED) != 0u;
  if (has_border) ox_add_border(m, choice, side);
  bool any = false;
  for (uint pass = 0u; pass < 2u && !any; ++pass) {  // those on the rim only if there are no others
    bool own = false;
    for (uint k = OX_ITEM; k < r->count; k += OX_ITEMS) {
      __global const ox_feature* f = ox_feature_of(r, k);
      if (!ox_is_on(f->flags, side) || ox_is_on_rim(r, f, &choice->plane) != (pass == 1u)) continue;
      if (has_border && ox_side_of(f->flags) != side && ox_is_of_border(r, f)) continue;
      ox_add_feature_contact(m, choice, f);
      own = true;
    }
    any = ox_any_item(own);
  }
}

#endif
