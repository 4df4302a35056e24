// SPDX-License-Identifier: BSD-3-Clause
// Edge step: can this edge cross the target? Then it goes to the list of edge rays.
//
// in    tasks of edges (their list), pairs, meshes, chunks, edges, grids
// out   rays; `vertex` of an edge ray is the edge
// item  1 edge of 1 chunk: item i is edge i % 16 of task i / 16 of the list (grid-stride)
// may overflow: OX_LIST_RAYS_EDGES
#include "shared/edge_ray.h"

__kernel void edge_step(__global volatile uint* counters, __global const ox_list* lists,
                        __global const ox_chunk_task* tasks, __global const ox_pair* pairs,
                        __global const ox_mesh* meshes, __global const ox_chunk* chunks,
                        __global const ox_edge* edges, __global const uint* grids,
                        __global ox_ray* rays, __global ox_work* works) {
  const uint first = lists[OX_LIST_CHUNKS_EDGES].first;
  const uint count = ox_length(counters, lists, OX_LIST_CHUNKS_EDGES) * OX_CHUNK_VERTICES;
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < count; i += stride) {
    __global const ox_chunk_task* task = tasks + first + i / OX_CHUNK_VERTICES;
    ox_work work = {0u, 0u, 0u, 0u};
    const uint edge = ox_choose_edge(task, i % OX_CHUNK_VERTICES, pairs, meshes, chunks, edges,
                                     grids, &work.vertex);
    ox_note_work(works, i, &work);
    if (edge == OX_NONE) continue;
    const uint slot = ox_append(counters, lists, OX_LIST_RAYS_EDGES);
    if (slot == OX_NONE) continue;
    rays[slot].pair_side = task->pair_side;
    rays[slot].vertex = edge;
    rays[slot].memory = OX_NONE;
    rays[slot].triangle = OX_NONE;
  }
}
