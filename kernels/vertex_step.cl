// SPDX-License-Identifier: BSD-3-Clause
// Vertex step (GRAPP section 3.2): can this vertex be in contact with the target? Then it gets a
// ray. Of those sides of pairs alone of which crossings cannot tell (lib/flooded.h,
// flood.cl).
//
// in    tasks, pairs, meshes, chunks, vertices
// out   rays
// item  1 vertex of 1 chunk: item i is vertex i % 16 of task i / 16 of the list (grid-stride)
// may overflow: OX_LIST_RAYS
#include "lib/vertex_ray.h"

static void ox_choose_vertices(const ox_scene* scene) {
  const uint count = ox_length(scene, OX_LIST_CHUNKS) * OX_CHUNK_VERTICES;
  for (uint i = scene->item; i < count; i += scene->item_count) {
    __global const ox_chunk_task* task =
        scene->tasks + scene->lists[OX_LIST_CHUNKS].first + i / OX_CHUNK_VERTICES;
    __global const ox_chunk* chunk = scene->chunks + task->chunk;
    const uint lane = i % OX_CHUNK_VERTICES;
    if (lane < chunk->count) ox_append_ray(scene, task->pair_side, chunk->first + lane);
  }
}

__kernel void vertex_step(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_choose_vertices(&scene);
}
