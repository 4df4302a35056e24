// SPDX-License-Identifier: BSD-3-Clause
// Vertex step (GRAPP section 3.2): can this vertex be inside the target? Then it gets a ray.
//
// in    tasks (counter OX_COUNTER_CHUNKS), pairs, meshes, chunks, vertices, grids
// out   rays
// item  1 vertex of 1 chunk: item i is vertex i % 16 of task i / 16 (grid-stride)
// may overflow: OX_COUNTER_RAYS
#include "shared/transform.h"

// Inside a closed mesh is inside its box and not in a cell that is wholly outside.
static bool ox_may_be_inside(__global const ox_mesh* mesh, __global const uint* grids, float3 p,
                             float epsilon) {
  const float3 d = fabs(p - vload3(0, mesh->box_centre));
  const float3 limit = vload3(0, mesh->box_half) + epsilon;
  if (d.x > limit.x || d.y > limit.y || d.z > limit.z) return false;
  if ((mesh->flags & OX_MESH_GRID) == 0u) return true;
  // As may_be_inside on the host: compared before it is converted.
  const float point[3] = {p.x, p.y, p.z};
  uint bit = 0u;
  for (uint axis = 3u; axis-- > 0u;) {
    const float cell = (point[axis] - mesh->grid_origin[axis]) * mesh->grid_scale[axis];
    if (!(cell >= 0.0f && cell < (float)mesh->grid_cells[axis])) return false;
    bit = bit * mesh->grid_cells[axis] + (uint)cell;
  }
  return (grids[mesh->grid_first + (bit >> 5)] >> (bit & 31u) & 1u) != 0u;
}

// What a ray of length `length` can meet of an open mesh lies where it crosses the box.
static bool ox_reaches_box(__global const ox_mesh* mesh, float3 p, float3 direction, float length,
                           float epsilon) {
  const float3 d = p - vload3(0, mesh->box_centre);
  const float3 half_size = vload3(0, mesh->box_half) + epsilon;
  const float start[3] = {d.x, d.y, d.z};
  const float along[3] = {direction.x, direction.y, direction.z};
  const float limit[3] = {half_size.x, half_size.y, half_size.z};
  float t0 = 0.0f;
  float t1 = length;
  for (uint k = 0u; k < 3u; ++k) {
    if (along[k] == 0.0f) {
      if (fabs(start[k]) > limit[k]) return false;
      continue;
    }
    const float u = (-limit[k] - start[k]) / along[k];
    const float v = (limit[k] - start[k]) / along[k];
    t0 = ox_max(t0, ox_min(u, v));
    t1 = ox_min(t1, ox_max(u, v));
  }
  return t0 <= t1;
}

__kernel void vertex_step(__global volatile uint* counters, __global const ox_chunk_task* tasks,
                          uint task_capacity, __global const ox_pair* pairs,
                          __global const ox_mesh* meshes, __global const ox_chunk* chunks,
                          __global const ox_vertex* vertices, __global const uint* grids,
                          __global ox_ray* rays, uint capacity) {
  const uint task_count = min(counters[OX_COUNTER_CHUNKS * OX_COUNTER_STRIDE], task_capacity);
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < task_count * OX_CHUNK_VERTICES; i += stride) {
    __global const ox_chunk_task* task = tasks + i / OX_CHUNK_VERTICES;
    __global const ox_chunk* chunk = chunks + task->chunk;
    const uint lane = i % OX_CHUNK_VERTICES;
    if (lane >= chunk->count) continue;

    __global const ox_vertex* vertex = vertices + chunk->first + lane;
    const float3 direction = vload3(0, vertex->direction);
    if (direction.x == 0.0f && direction.y == 0.0f && direction.z == 0.0f) continue;
    __global const ox_pair* pair = pairs + (task->pair_side >> 1);
    const uint side = task->pair_side & 1u;
    __global const ox_mesh* target = meshes + pair->mesh[1u - side];
    const float3 p = ox_place(pair, side, vload3(0, vertex->position));
    if ((target->flags & OX_MESH_CLOSED) != 0u) {
      if (!ox_may_be_inside(target, grids, p, pair->epsilon)) continue;
    } else {
      if (vertex->exit == INFINITY) continue;  // it would never end: see ray_step
      const float3 d = ox_turn(pair, side, direction);
      if (!ox_reaches_box(target, p, d, vertex->exit + pair->epsilon, pair->epsilon)) continue;
    }
    const uint slot = atomic_inc(counters + OX_COUNTER_RAYS * OX_COUNTER_STRIDE);
    if (slot >= capacity) continue;
    rays[slot].pair_side = task->pair_side;
    rays[slot].vertex = chunk->first + lane;
  }
}
