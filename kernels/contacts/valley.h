// SPDX-License-Identifier: BSD-3-Clause
// Chords of valleys: of edges at which their mesh bends inwards, and goes on at both sides. Device
// only.
#ifndef ODE_EXT_KERNELS_CONTACTS_VALLEY_H
#define ODE_EXT_KERNELS_CONTACTS_VALLEY_H

#include "contacts/unit_moves.h"

static inline bool ox_is_of_valley(const ox_region_view* r, uint k) {
  return !ox_is_vertex(ox_flags_of(r, k)) &&
         ox_is_valley(r->scene, r->pair, ox_feature_of(r, k)->source);
}

// Whether a unit is a vertex at which valleys meet alone.
static inline bool ox_is_between_valleys(const ox_region_view* r, uint k) {
  __global const ox_feature* f = ox_feature_of(r, k);
  if (!ox_is_vertex(f->flags)) return false;
  const ox_scene* scene = r->scene;
  __global const ox_mesh* mesh = ox_mesh_of(scene, scene->pairs + r->pair, ox_side_of(f->flags));
  for (uint i = scene->ring_starts[f->source]; i < scene->ring_starts[f->source + 1u]; ++i) {
    const uint edge = scene->rings[i].edge;
    if (!ox_is_flat_edge(mesh, edge) && !ox_is_valley(scene, r->pair, edge)) return false;
  }
  return true;
}

// Whether the mesh of a chord of a valley bends a little there, so that the faces face one way. The
// chord comes out past no face of the other mesh that does not: its own mesh goes on beside it, as
// a floor does on both sides of where it begins to rise.
static inline bool ox_is_of_bend(const ox_region_view* r, uint k) {
  __global const ox_feature* f = ox_feature_of(r, k);
  const uint side = ox_side_of(f->flags);
  return ox_dot(ox_normal_of(r->scene, r->pair, side, f->at[0]),
                ox_normal_of(r->scene, r->pair, side, f->at[1])) > OX_SAME_WAY;
}

// Whether the moves before together take a unit out, by less than a depth. The way past all planes
// is gone one plane after the other, a few times round, as each may take the others back; that is
// not the shortest one, and there may be more planes than contacts/joint_way.h has room for.
static inline bool ox_is_taken_out(const ox_region_view* r, uint unit, const ox_moves* before,
                                   float depth) {
  float3 way = (float3)(0.0f);
  for (uint sweep = 0u; sweep < OX_FEW; ++sweep)
    for (uint i = 0u; i < before->count; ++i) {
      const float3 normal = before->chosen[i].normal;
      way += ox_max(before->far[i] - ox_dot(way, normal), 0.0f) * normal;
    }
  const uint side = ox_side_of(ox_flags_of(r, unit));
  const float3 away = ox_way_of(side, way);
  return before->count != 0u && ox_dot(way, way) < depth * depth &&
         !ox_is_still_inside(r, side, ox_middle_of(r, unit) + away, away);
}

#endif
