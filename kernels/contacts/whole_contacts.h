// SPDX-License-Identifier: BSD-3-Clause
// Contacts of a region that one plane separates. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_WHOLE_CONTACTS_H
#define ODE_EXT_KERNELS_CONTACTS_WHOLE_CONTACTS_H

#include "contacts/candidates.h"

// Whether the border turns at a vertex, or the solid gets deeper along it, by the plane of the face
// that is below: else the vertex bounds nothing.
static inline bool ox_bounds_border(const ox_region_view* r, __global const ox_feature* f,
                                    uint below) {
  const ox_scene* scene = r->scene;
  const uint of = ox_side_of(f->flags);
  const float3 normal = ox_normal_of(scene, r->pair, 1u - of, below);
  float3 sum = (float3)(0.0f);  // of the directions of the border there
  for (uint i = scene->ring_starts[f->source]; i < scene->ring_starts[f->source + 1u]; ++i) {
    const uint edge = scene->rings[i].edge;
    if (!ox_is_border(scene, edge)) continue;
    const float3 direction = ox_ridge_of(scene, r->pair, of, edge).along;
    sum += scene->edges[edge].vertex[0] == f->source ? direction : -direction;
    if (fabs(ox_dot(direction, normal)) > OX_FACET_ANGLE) return true;
  }
  return ox_dot(sum, sum) > OX_FACET_ANGLE * OX_FACET_ANGLE;
}

// Contacts at the border of an open mesh, past a face of which mesh `side` is moved; returns
// whether there is any.
static inline bool ox_add_behind_border(const ox_manifold* m, const ox_plane_choice* choice,
                                        uint side) {
  const ox_region_view* r = m->region;
  bool any = false;
  for (uint k = 0u; k < r->count; ++k) {
    __global const ox_feature* f = ox_feature_of(r, k);
    ox_behind at[OX_BEHIND_FEATURE];
    const uint count = ox_find_behind_border(r, k, &choice->plane, at);
    for (uint i = 0u; i < count; ++i) {
      const bool is_vertex = ox_is_vertex(f->flags);
      const uint target = i == 0u && !is_vertex ? f->triangle : at[i].triangle;
      // Where the border enters the solid by the face that is below, nothing is.
      if (i == 0u &&
          (is_vertex ? !ox_bounds_border(r, f, at[0].triangle)
                     : ox_facet_of(r->scene, target) == ox_facet_of(r->scene, at[0].triangle)))
        continue;
      const float depth = ox_plane_depth(&choice->plane, side, at[i].position) + at[i].depth;
      if (ox_is_first_item())
        ox_add_candidate(m, choice, side, at[i].position, ox_max(depth, 0.0f), OX_HIT_POINT, target,
                         choice->plane.id[0], ox_touch_of(f, target));
      any = true;
    }
  }
  return any;
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
  const bool has_border = ox_has_border(r, &choice->plane);
  const bool at_border = has_border && ox_add_behind_border(m, choice, side);
  bool any = false;
  // Those on the rim only if there are no others, and of the border if there are none at all.
  for (uint pass = 0u; pass < (at_border ? 2u : 3u) && !any; ++pass) {
    bool own = false;
    for (uint k = OX_ITEM; k < r->count; k += OX_ITEMS) {
      __global const ox_feature* f = ox_feature_of(r, k);
      if (!ox_is_on(f->flags, side)) continue;
      const bool is_border =
          has_border && ox_side_of(f->flags) != side && ox_is_of_border(r->scene, f);
      if (pass != (is_border ? 2u : ox_is_on_rim(r, f, &choice->plane) ? 1u : 0u)) continue;
      ox_add_feature_contact(m, choice, f);
      own = true;
    }
    any = ox_any_item(own);
  }
}

#endif
