// SPDX-License-Identifier: BSD-3-Clause
// The vertex step of all categories of pairs (GRAPP section 3.2): can this vertex be in contact
// with the target? Then it gets a ray, in the list of the algorithm that is to cast it.
//
// in    tasks of one category (its list), pairs, meshes, chunks, vertices, temporal_before
// out   rays
//       temporal: cleared for every vertex of a task whose pair keeps temporal data
// item  1 vertex of 1 chunk: item i is vertex i % 16 of task i / 16 of the list (grid-stride)
// may overflow: OX_LIST_RAYS_ITERATIVE, OX_LIST_RAYS, OX_LIST_RAYS_BASIC
#include "paper/choose.h"
#include "paper/note_work.h"

__kernel void vertex_rays(OX_SCENE_PARAMETERS, uint category, float displacement_limit,
                          __global const ox_temporal* temporal_before,
                          __global ox_temporal* temporal, __global ox_work* works) {
  const ox_scene scene = OX_SCENE;
  const uint first = lists[category].first;
  const uint count = ox_length(&scene, category) * OX_CHUNK_VERTICES;
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < count; i += stride) {
    const uint task = first + i / OX_CHUNK_VERTICES;
    ox_work work = {0u, 0u, 0u, 0u};
    const ox_choice choice = ox_choose(&scene, task, i % OX_CHUNK_VERTICES, displacement_limit,
                                       temporal_before, temporal, &work);
    ox_note_work(works, i, &work);
    if (choice.list == OX_NONE) continue;
    const uint index = ox_append(&scene, choice.list);
    if (index == OX_NONE) continue;
    rays[index].pair_side = tasks[task].pair_side;
    rays[index].vertex = choice.vertex;
    rays[index].memory = choice.memory;
    rays[index].triangle = choice.triangle;
  }
}
