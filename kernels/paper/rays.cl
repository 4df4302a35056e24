// SPDX-License-Identifier: BSD-3-Clause
// The ray step of all algorithms (GRAPP section 3.3), a kernel each: where does the ray from this
// vertex leave the target?
//
// in    rays of one algorithm (its list), pairs, meshes, vertices, edges, triangles, meshlets,
//       meshlet_nodes
// out   hits: of vertices that are inside
//       temporal: the triangle from which the next pass may start
//       rays: those that the iterative algorithm hands on to a full one
// item  1 ray (grid-stride); no barrier
// may overflow: OX_LIST_HITS; the iterative kernel also OX_LIST_RAYS, OX_LIST_RAYS_BASIC
#include "paper/cast.h"
#include "paper/choose.h"
#include "paper/note_work.h"

static inline void ox_cast_list(const ox_scene* scene, uint list, uint walk_limit,
                                __global ox_temporal* temporal, __global ox_work* works) {
  const uint first = scene->lists[list].first;
  const uint count = ox_length(scene, list);
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < count; i += stride) {
    ox_ray ray = scene->rays[first + i];
    ox_outcome outcome;
    ox_work work = {0u, 0u, 0u, 0u};
    const bool done = ox_cast_ray(scene, list, &ray, walk_limit, temporal, &outcome, &work);
    ox_note_work(works, i, &work);
    if (done) {
      ox_append_hit(scene, &ray, false, OX_NONE, OX_NONE, &outcome);
      continue;
    }
    ox_count(scene, OX_COUNTER_UNPROVEN);
    const uint index = ox_append(scene, ox_full_list(scene, ray.pair_side));
    if (index != OX_NONE) scene->rays[index] = ray;
  }
}

__kernel void rays_iterative(OX_SCENE_PARAMETERS, uint walk_limit, __global ox_temporal* temporal,
                             __global ox_work* works) {
  const ox_scene scene = OX_SCENE;
  ox_cast_list(&scene, OX_LIST_RAYS_ITERATIVE, walk_limit, temporal, works);
}

__kernel void rays_full(OX_SCENE_PARAMETERS, uint walk_limit, __global ox_temporal* temporal,
                        __global ox_work* works) {
  const ox_scene scene = OX_SCENE;
  ox_cast_list(&scene, OX_LIST_RAYS, walk_limit, temporal, works);
}

__kernel void rays_basic(OX_SCENE_PARAMETERS, uint walk_limit, __global ox_temporal* temporal,
                         __global ox_work* works) {
  const ox_scene scene = OX_SCENE;
  ox_cast_list(&scene, OX_LIST_RAYS_BASIC, walk_limit, temporal, works);
}
