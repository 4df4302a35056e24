// SPDX-License-Identifier: BSD-3-Clause
// What takes a unit of a deformable mesh out along with what is about it: a move before, or one
// past a face of its own mesh. Device only.
//
// Every triangle of a deformable mesh is a facet and every vertex a unit, also within a floor that
// is flat, far from where the body on it ends. What of the body is below the floor need not go so
// far, and takes the rest of it along.
#ifndef ODE_EXT_KERNELS_CONTACTS_OWN_FACES_H
#define ODE_EXT_KERNELS_CONTACTS_OWN_FACES_H

#include "contacts/unit_plane.h"
#include "contacts/whole_region.h"

// Whether a move before that is less deep takes a unit out.
static inline bool ox_is_taken_along(const ox_region_view* r, uint unit, const ox_moves* before,
                                     float depth) {
  const uint side = ox_side_of(ox_flags_of(r, unit));
  for (uint i = 0u; i < before->count; ++i)
    if (before->far[i] < depth &&
        !ox_stays_inside(r, side, ox_middle_of(r, unit), before->chosen + i, before->far[i]))
      return true;
  return false;
}

// Whether a move before goes the same way.
static inline bool ox_has_moved(const ox_moves* before, float3 normal) {
  for (uint i = 0u; i < before->count; ++i)
    if (ox_dot(before->chosen[i].normal, normal) > OX_SAME_WAY) return true;
  return false;
}

// Takes the plane of a face of mesh `side`, which clears all that the region has of the other, if
// it is better and no deeper than that of another.
static inline void ox_try_own_face(const ox_region_view* r, uint side, uint triangle,
                                   const ox_moves* before, const ox_plane_choice* other,
                                   ox_plane_choice* best) {
  if (triangle == OX_NONE) return;
  ox_plane_choice choice = ox_no_choice();
  choice.plane = ox_plane_of_face(r->scene, r->pair, side, triangle);
  if (choice.plane.kind == OX_PLANE_NONE) return;
  const float3 past = -ox_way_of(1u - side, choice.plane.normal);
  choice.depth = choice.plane.level[1u - side] + ox_farthest_along(r, 1u - side, past);
  // Below 0: nothing of the other mesh is there.
  if (!(choice.depth >= 0.0f) || !(choice.depth < other->depth)) return;
  choice.judged = ox_cost_of(r, before, &choice.plane, choice.depth);
  if (ox_is_better_choice(&choice, best)) *best = choice;
}

// The best of the planes of the faces at a unit, if it is better than one of the other mesh and
// takes the unit out; else none.
static inline ox_plane_choice ox_choose_own_face(const ox_region_view* r, uint unit,
                                                 const ox_moves* before,
                                                 const ox_plane_choice* other) {
  const ox_scene* scene = r->scene;
  __global const ox_feature* f = ox_feature_of(r, unit);
  const uint side = ox_side_of(f->flags);
  ox_plane_choice best = *other;
  if (ox_is_vertex(f->flags)) {
    for (uint i = scene->ring_starts[f->source]; i < scene->ring_starts[f->source + 1u]; ++i) {
      __global const ox_edge* edge = scene->edges + scene->rings[i].edge;
      for (uint k = 0u; k < 2u; ++k)
        ox_try_own_face(r, side, edge->triangle[k], before, other, &best);
    }
  } else {
    for (uint k = 0u; k < 2u; ++k) ox_try_own_face(r, side, f->at[k], before, other, &best);
  }
  return ox_is_same_plane(&best.plane, &other->plane) ||
                 ox_stays_inside(r, side, ox_middle_of(r, unit), &best.plane, best.depth)
             ? ox_no_choice()
             : best;
}

// The member of the other mesh that is deepest below such a plane; OX_NONE: there is no plane.
static inline uint ox_deepest_below(const ox_region_view* r, const ox_plane_choice* own) {
  if (own->plane.kind == OX_PLANE_NONE) return OX_NONE;
  return ox_find_farthest(r, ox_clears_side(&own->plane, 0u) ? 0u : 1u, own->plane.normal);
}

#endif
