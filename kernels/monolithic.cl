// SPDX-License-Identifier: BSD-3-Clause
// The monolithic organisation, which the pipeline is compared with (GRAPP section 3): one large
// kernel that culls each vertex of every pair, and casts its ray by whichever algorithm a switch
// selects. Same tests, same culls, same data; only the input is sparse and the branches diverge.
//
// in    tasks: one for every chunk of every pair, most with nothing to do; pairs, meshes,
//       chunks, vertices, triangles, meshlets, meshlet_nodes, temporal_before
// out   hits, and per pair their number; temporal
// item  1 vertex of 1 chunk of 1 pair, whether it can collide or not (grid-stride)
// may overflow: OX_LIST_HITS
#include "shared/cast.h"
#include "shared/choose.h"

__kernel void monolithic(__global volatile uint* counters, __global const ox_list* lists,
                         __global const ox_chunk_task* tasks, uint task_count,
                         __global const ox_pair* pairs, __global const ox_mesh* meshes,
                         __global const ox_chunk* chunks, __global const ox_vertex* vertices,
                         __global const ox_triangle* triangles, __global const ox_meshlet* meshlets,
                         __global const ox_meshlet_node* meshlet_nodes, uint rays_mode,
                         float displacement_limit, uint walk_limit,
                         __global const ox_temporal* temporal_before,
                         __global ox_temporal* temporal, __global volatile uint* pair_hits,
                         __global ox_hit* hits, __global ox_work* works) {
  const ox_surfaces surfaces = {triangles, meshlets, meshlet_nodes};
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < task_count * OX_CHUNK_VERTICES; i += stride) {
    const uint task = i / OX_CHUNK_VERTICES;
    ox_work work = {0u, 0u, 0u, 0u};
    const ox_choice choice =
        ox_choose(counters, tasks, task, i % OX_CHUNK_VERTICES, pairs, meshes, chunks, vertices,
                  rays_mode, displacement_limit, temporal_before, temporal, &work);
    if (choice.list != OX_NONE) {
      ox_ray ray;
      ray.pair_side = tasks[task].pair_side;
      ray.vertex = choice.vertex;
      ray.memory = choice.memory;
      ray.triangle = choice.triangle;
      ox_outcome outcome;
      bool done = false;
      uint list = choice.list;
      ox_count(counters, list);
      while (!done) {
        switch (list) {
          case OX_LIST_RAYS_ITERATIVE:
            done = ox_cast_ray(OX_LIST_RAYS_ITERATIVE, &ray, pairs, meshes, vertices, &surfaces,
                               rays_mode, walk_limit, temporal, &outcome, &work);
            if (!done) {
              ox_count(counters, OX_COUNTER_UNPROVEN);
              list = ox_full_list(pairs, meshes, ray.pair_side, rays_mode);
              ox_count(counters, list);
            }
            break;
          case OX_LIST_RAYS_BASIC:
            done = ox_cast_ray(OX_LIST_RAYS_BASIC, &ray, pairs, meshes, vertices, &surfaces,
                               rays_mode, walk_limit, temporal, &outcome, &work);
            break;
          default:
            done = ox_cast_ray(OX_LIST_RAYS_BVH, &ray, pairs, meshes, vertices, &surfaces,
                               rays_mode, walk_limit, temporal, &outcome, &work);
        }
      }
      ox_append_hit(counters, lists, &ray, &outcome, pair_hits, hits);
    }
    ox_note_work(works, i, &work);
  }
}
