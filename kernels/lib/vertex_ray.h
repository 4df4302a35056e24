// SPDX-License-Identifier: BSD-3-Clause
// The rays of vertices: who gets one, and what it hits. Device only.
#ifndef ODE_EXT_KERNELS_LIB_VERTEX_RAY_H
#define ODE_EXT_KERNELS_LIB_VERTEX_RAY_H

#include "lib/append.h"
#include "lib/cull.h"
#include "lib/full_ray.h"

static inline bool ox_casts_ray(__global const ox_vertex* vertex) {
  const float3 direction = vload3(0, vertex->direction);
  return direction.x != 0.0f || direction.y != 0.0f || direction.z != 0.0f;
}

// Whether a vertex can be in contact.
static inline bool ox_may_cast(const ox_scene* scene, uint pair_side, uint vertex) {
  return ox_casts_ray(scene->vertices + vertex) &&
         ox_keep_vertex(scene->pairs + (pair_side >> 1), pair_side & 1u, scene->meshes,
                        scene->vertices + vertex);
}

// `memory`: OX_RAY_...; of a vertex that is inside a closed target `from` is as in ox_hit, else
// OX_NONE. Of an index that is OX_NONE nothing.
static inline void ox_store_ray(const ox_scene* scene, uint index, uint pair_side, uint vertex,
                                uint memory, uint from) {
  if (index == OX_NONE) return;
  scene->rays[index].pair_side = pair_side;
  scene->rays[index].vertex = vertex;
  scene->rays[index].memory = memory;
  scene->rays[index].triangle = from;
}

static inline void ox_append_ray(const ox_scene* scene, uint pair_side, uint vertex) {
  if (ox_may_cast(scene, pair_side, vertex))
    ox_store_ray(scene, ox_append(scene, OX_LIST_RAYS), pair_side, vertex, OX_RAY_ASKING, OX_NONE);
}

// The vertex of a ray, if it is inside. `known`: it is, whatever its ray meets. `from` and `edge`:
// as in ox_hit.
static inline void ox_append_hit(const ox_scene* scene, const ox_ray* ray, bool known, uint from,
                                 uint edge, const ox_outcome* outcome) {
  const uint kind = outcome->kind & OX_HIT_KIND;
  const bool leaves = kind == OX_HIT_INSIDE || kind == OX_HIT_FALLBACK;
  if (!leaves && !known) return;
  const uint index = ox_append(scene, OX_LIST_HITS);
  if (index == OX_NONE) return;
  __global ox_hit* hit = scene->hits + index;
  hit->pair_side = ray->pair_side;
  hit->vertex = ray->vertex;
  hit->triangle = leaves ? outcome->triangle : OX_NONE;
  hit->kind = outcome->kind;
  hit->depth = outcome->depth;
  hit->t = outcome->t;
  hit->from = from;
  hit->edge = edge;
}

#endif
