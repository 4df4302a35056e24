// SPDX-License-Identifier: BSD-3-Clause
// Vertex step (GRAPP section 3.2): can this vertex be in contact with the target? Then it gets a
// ray, in the list of the algorithm that is to cast it.
//
// in    tasks of one category (its list), pairs, meshes, chunks, vertices, temporal_before
// out   rays
//       temporal: cleared for every vertex of a task whose pair keeps temporal data
// item  1 vertex of 1 chunk: item i is vertex i % 16 of task i / 16 of the list (grid-stride)
// may overflow: OX_LIST_RAYS_ITERATIVE, OX_LIST_RAYS_BVH, OX_LIST_RAYS_BASIC
#include "shared/choose.h"

static void ox_vertex_step(uint category, __global volatile uint* counters,
                           __global const ox_list* lists, __global const ox_chunk_task* tasks,
                           __global const ox_pair* pairs, __global const ox_mesh* meshes,
                           __global const ox_chunk* chunks, __global const ox_vertex* vertices,
                           uint rays_mode, float displacement_limit,
                           __global const ox_temporal* temporal_before,
                           __global ox_temporal* temporal, __global ox_ray* rays,
                           __global ox_work* works) {
  const uint first = lists[category].first;
  const uint count = ox_length(counters, lists, category) * OX_CHUNK_VERTICES;
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < count; i += stride) {
    const uint task = first + i / OX_CHUNK_VERTICES;
    ox_work work = {0u, 0u, 0u, 0u};
    const ox_choice choice =
        ox_choose(counters, tasks, task, i % OX_CHUNK_VERTICES, pairs, meshes, chunks, vertices,
                  rays_mode, displacement_limit, temporal_before, temporal, &work);
    ox_note_work(works, i, &work);
    if (choice.list == OX_NONE) continue;
    const uint slot = ox_append(counters, lists, choice.list);
    if (slot == OX_NONE) continue;
    rays[slot].pair_side = tasks[task].pair_side;
    rays[slot].vertex = choice.vertex;
    rays[slot].memory = choice.memory;
    rays[slot].triangle = choice.triangle;
  }
}

// Rigid pairs that moved little: those with temporal data go to the iterative algorithm.
__kernel void vertex_small(__global volatile uint* counters, __global const ox_list* lists,
                           __global const ox_chunk_task* tasks, __global const ox_pair* pairs,
                           __global const ox_mesh* meshes, __global const ox_chunk* chunks,
                           __global const ox_vertex* vertices, uint rays_mode,
                           float displacement_limit, __global const ox_temporal* temporal_before,
                           __global ox_temporal* temporal, __global ox_ray* rays,
                           __global ox_work* works) {
  ox_vertex_step(OX_CATEGORY_SMALL, counters, lists, tasks, pairs, meshes, chunks, vertices,
                 rays_mode, displacement_limit, temporal_before, temporal, rays, works);
}

// Rigid pairs that moved far.
__kernel void vertex_high(__global volatile uint* counters, __global const ox_list* lists,
                          __global const ox_chunk_task* tasks, __global const ox_pair* pairs,
                          __global const ox_mesh* meshes, __global const ox_chunk* chunks,
                          __global const ox_vertex* vertices, uint rays_mode,
                          float displacement_limit, __global const ox_temporal* temporal_before,
                          __global ox_temporal* temporal, __global ox_ray* rays,
                          __global ox_work* works) {
  ox_vertex_step(OX_CATEGORY_HIGH, counters, lists, tasks, pairs, meshes, chunks, vertices,
                 rays_mode, displacement_limit, temporal_before, temporal, rays, works);
}

// Pairs with a deformable mesh: each vertex by its own displacement.
__kernel void vertex_deformable(__global volatile uint* counters, __global const ox_list* lists,
                                __global const ox_chunk_task* tasks, __global const ox_pair* pairs,
                                __global const ox_mesh* meshes, __global const ox_chunk* chunks,
                                __global const ox_vertex* vertices, uint rays_mode,
                                float displacement_limit,
                                __global const ox_temporal* temporal_before,
                                __global ox_temporal* temporal, __global ox_ray* rays,
                                __global ox_work* works) {
  ox_vertex_step(OX_CATEGORY_DEFORMABLE, counters, lists, tasks, pairs, meshes, chunks, vertices,
                 rays_mode, displacement_limit, temporal_before, temporal, rays, works);
}
