// SPDX-License-Identifier: BSD-3-Clause
// The monolithic organization, which the pipeline is compared with (GRAPP section 3): one large
// kernel that culls each vertex of every pair, and casts its ray by whichever algorithm a switch
// selects. Same tests, same culls, same data; only the input is sparse and the branches diverge.
//
// in    tasks: one for every chunk of every pair, most with nothing to do; pairs, meshes,
//       chunks, vertices, edges, triangles, meshlets, meshlet_nodes, temporal_before
// out   hits: of vertices that are inside; temporal
// item  1 vertex of 1 chunk of 1 pair, whether it can collide or not (grid-stride)
// may overflow: OX_LIST_HITS
#include "paper/cast.h"
#include "paper/choose.h"
#include "paper/note_work.h"

__kernel void monolithic(OX_SCENE_PARAMETERS, uint task_count, float displacement_limit,
                         uint walk_limit, __global const ox_temporal* temporal_before,
                         __global ox_temporal* temporal, __global ox_work* works) {
  const ox_scene scene = OX_SCENE;
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < task_count * OX_CHUNK_VERTICES; i += stride) {
    const uint task = i / OX_CHUNK_VERTICES;
    ox_work work = {0u, 0u, 0u, 0u};
    const ox_choice choice = ox_choose(&scene, task, i % OX_CHUNK_VERTICES, displacement_limit,
                                       temporal_before, temporal, &work);
    if (choice.list != OX_NONE) {
      ox_ray ray;
      ray.pair_side = tasks[task].pair_side;
      ray.vertex = choice.vertex;
      ray.memory = choice.memory;
      ray.triangle = choice.triangle;
      ox_outcome outcome;
      bool done = false;
      uint list = choice.list;
      ox_count(&scene, list);
      while (!done) {
        switch (list) {
          case OX_LIST_RAYS_ITERATIVE:
            done = ox_cast_ray(&scene, OX_LIST_RAYS_ITERATIVE, &ray, walk_limit, temporal, &outcome,
                               &work);
            if (!done) {
              ox_count(&scene, OX_COUNTER_UNPROVEN);
              list = ox_full_list(&scene, ray.pair_side);
              ox_count(&scene, list);
            }
            break;
          case OX_LIST_RAYS_BASIC:
            done = ox_cast_ray(&scene, OX_LIST_RAYS_BASIC, &ray, walk_limit, temporal, &outcome,
                               &work);
            break;
          default:
            done = ox_cast_ray(&scene, OX_LIST_RAYS, &ray, walk_limit, temporal, &outcome, &work);
        }
      }
      ox_append_hit(&scene, &ray, false, OX_NONE, OX_NONE, &outcome);
    }
    ox_note_work(works, i, &work);
  }
}
