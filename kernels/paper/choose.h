// SPDX-License-Identifier: BSD-3-Clause
// Which ray algorithm a vertex gets (GRAPP section 3.2), the same in both organizations. Device
// only.
#ifndef ODE_EXT_KERNELS_PAPER_CHOOSE_H
#define ODE_EXT_KERNELS_PAPER_CHOOSE_H

#include "abi/paper.h"
#include "lib/vertex_ray.h"

#define OX_WORK_TASK 1u
#define OX_WORK_VERTEX 2u

// One vertex of a task.
typedef struct {
  uint list;      // OX_LIST_RAYS_..., or OX_NONE: no ray
  uint vertex;    // over all meshes
  uint memory;    // as in ox_ray
  uint triangle;  // as in ox_ray
} ox_choice;

// How far a vertex moved in the frame of the target since the last pass, at most [m]. For rigid
// pairs chunk_tasks.cl has judged that already.
static inline float ox_displacement(__global const ox_pair* pair, uint side,
                                    __global const ox_mesh* target,
                                    __global const ox_vertex* vertex) {
  return pair->displacement[side] + vertex->moved + target->moved;
}

// The list of the full algorithm for the target of a ray.
static inline uint ox_full_list(const ox_scene* scene, uint pair_side) {
  __global const ox_mesh* target =
      scene->meshes + scene->pairs[pair_side >> 1].mesh[1u - (pair_side & 1u)];
  return (target->flags & OX_MESH_DEFORMABLE) != 0u && (scene->modes & OX_MODE_BASIC) != 0u
             ? OX_LIST_RAYS_BASIC
             : OX_LIST_RAYS;
}

// `task_index` and `lane`: the vertex. Clears its temporal datum; the ray step sets it.
static inline ox_choice ox_choose(const ox_scene* scene, uint task_index, uint lane,
                                  float displacement_limit,
                                  __global const ox_temporal* temporal_before,
                                  __global ox_temporal* temporal, ox_work* work) {
  ox_choice choice;
  choice.list = OX_NONE;
  choice.memory = OX_NONE;
  choice.triangle = OX_NONE;
  work->vertex += OX_WORK_TASK;
  __global const ox_chunk_task* task = scene->tasks + task_index;
  if (task->chunk == OX_NONE) return choice;
  __global const ox_chunk* chunk = scene->chunks + task->chunk;
  if (lane >= chunk->count) return choice;

  choice.vertex = chunk->first + lane;
  if ((task->category & OX_CATEGORY_REMEMBERED) != 0u) {
    choice.memory = task_index * OX_CHUNK_VERTICES + lane;
    temporal[choice.memory].triangle = OX_NONE;
    temporal[choice.memory].moved = 0.0f;
  }
  __global const ox_vertex* vertex = scene->vertices + choice.vertex;
  if (!ox_casts_ray(vertex)) return choice;

  const uint side = task->pair_side & 1u;
  __global const ox_pair* pair = scene->pairs + (task->pair_side >> 1);
  __global const ox_mesh* target = scene->meshes + pair->mesh[1u - side];
  const bool paper = (scene->modes & OX_MODE_PAPER) != 0u;
  ox_temporal before;
  before.triangle = OX_NONE;
  before.moved = INFINITY;
  if (task->previous != OX_NONE)
    before = temporal_before[task->previous * OX_CHUNK_VERTICES + lane];
  bool small = (task->category & OX_CATEGORY_MASK) == OX_CATEGORY_SMALL;
  if ((task->category & OX_CATEGORY_MASK) == OX_CATEGORY_DEFORMABLE && task->previous != OX_NONE) {
    // Each vertex has its own displacement (GRAPP 3.2). Where those without temporal data are
    // dropped it counts from the last time the vertex was cast in full.
    float moved = ox_displacement(pair, side, target, vertex);
    if (paper) moved += before.moved;
    small = moved < INFINITY && moved <= displacement_limit * target->mean_edge;
    if (choice.memory != OX_NONE) temporal[choice.memory].moved = small ? moved : 0.0f;
  }
  if (small) choice.triangle = before.triangle;
  const bool iterative = small && choice.triangle != OX_NONE;
  if (!(paper && iterative)) {
    work->vertex += OX_WORK_VERTEX;
    if (!ox_keep_vertex(pair, side, scene->meshes, vertex)) return choice;
    if (paper && small) {  // the paper has no ray for it
      ox_count(scene, OX_COUNTER_DROPPED);
      return choice;
    }
  }
  choice.list = iterative ? OX_LIST_RAYS_ITERATIVE : ox_full_list(scene, task->pair_side);
  return choice;
}

#endif
