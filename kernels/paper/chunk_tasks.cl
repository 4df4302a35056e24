// SPDX-License-Identifier: BSD-3-Clause
// Chunk tasks (the second half of GRAPP section 3.1): which vertices of a pair are to be looked at,
// and how far can they have moved?
//
// in    pairs, meshes, chunks, links
// out   tasks: runs of vertices whose box reaches the target's, in three lists: rigid pairs with
//       small displacement, with high displacement, pairs with a deformable mesh
//       pairs: displacement
//       poses, directory: what the next pass needs to find its temporal data
// item  1 pair (grid-stride)
// may overflow: OX_LIST_CHUNKS_SMALL, OX_LIST_CHUNKS, OX_LIST_CHUNKS_DEFORMABLE
#include "abi/paper.h"
#include "lib/append.h"
#include "lib/cull.h"

// The angle between two relative poses [rad]; accurate for all of them, unlike the arc cosine.
static float ox_turned_by(__global const float* rotation, __global const float* before) {
  const float3 row0 = vload3(0, rotation);
  const float3 row1 = vload3(1, rotation);
  const float3 row2 = vload3(2, rotation);
  const float3 old0 = vload3(0, before);
  const float3 old1 = vload3(1, before);
  const float3 old2 = vload3(2, before);
  const float3 axis =
      (float3)(ox_dot(row2, old1) - ox_dot(row1, old2), ox_dot(row0, old2) - ox_dot(row2, old0),
               ox_dot(row1, old0) - ox_dot(row0, old1));
  const float trace = ox_dot(row0, old0) + ox_dot(row1, old1) + ox_dot(row2, old2);
  return atan2(sqrt(ox_dot(axis, axis)), trace - 1.0f);  // both twice: sine and cosine
}

// How far the vertices of each mesh moved in the other's frame at most (GRAPP section 3.2): as the
// middle of their bounding sphere did, and by the angle on its surface.
static void ox_displace(__global ox_pair* pair, __global const ox_relative_pose* before,
                        __global const ox_mesh* a, __global const ox_mesh* b) {
  const float angle = ox_turned_by(pair->rotation[0], before->rotation);
  const float3 old0 = vload3(0, before->rotation);
  const float3 old1 = vload3(1, before->rotation);
  const float3 old2 = vload3(2, before->rotation);
  const float3 ca = vload3(0, a->box_centre);
  const float3 cb = vload3(0, b->box_centre);
  const float3 a_was =
      (float3)(ox_dot(old0, ca), ox_dot(old1, ca), ox_dot(old2, ca)) + vload3(0, before->offset[0]);
  const float3 b_was = cb.x * old0 + cb.y * old1 + cb.z * old2 + vload3(0, before->offset[1]);
  const float3 a_moved = ox_transform(pair, 0u, ca) - a_was;
  const float3 b_moved = ox_transform(pair, 1u, cb) - b_was;
  pair->displacement[0] = sqrt(ox_dot(a_moved, a_moved)) + angle * a->radius;
  pair->displacement[1] = sqrt(ox_dot(b_moved, b_moved)) + angle * b->radius;
}

static void ox_store_pose(__global const ox_pair* pair, uint pass,
                          __global ox_relative_pose* pose) {
  pose->pass = pass;
  for (uint i = 0u; i < 9u; ++i) pose->rotation[i] = pair->rotation[0][i];
  for (uint i = 0u; i < 3u; ++i) {
    pose->offset[0][i] = pair->offset[0][i];
    pose->offset[1][i] = pair->offset[1][i];
  }
}

static uint ox_category(__global const ox_pair* pair, uint side, __global const ox_mesh* source,
                        __global const ox_mesh* target, float displacement_limit) {
  if (((source->flags | target->flags) & OX_MESH_DEFORMABLE) != 0u) return OX_CATEGORY_DEFORMABLE;
  const float displacement = pair->displacement[side];  // infinite: not known
  return displacement < INFINITY && displacement <= displacement_limit * target->mean_edge
             ? OX_CATEGORY_SMALL
             : OX_CATEGORY_HIGH;
}

// dense_first: used if is_dense. Per pair the place of its first chunk among those of all pairs.
// Then a task is written for every chunk, at its own place, and those with nothing to do say so.
__kernel void chunk_tasks(OX_SCENE_PARAMETERS, __global const ox_link* links, uint pass,
                          float displacement_limit, __global ox_relative_pose* poses,
                          __global ox_directory_entry* directory, uint is_dense,
                          __global const uint* dense_first) {
  const ox_scene scene = OX_SCENE;
  const uint parity = pass & 1u;  // what is read and what is written: a pass may be run again
  const uint stride = (uint)get_global_size(0);
  for (uint p = (uint)get_global_id(0); p < pair_count; p += stride) {
    __global ox_pair* pair = pairs + p;
    __global const ox_mesh* mesh_a = meshes + pair->mesh[0];
    __global const ox_mesh* mesh_b = meshes + pair->mesh[1];
    const bool near = pair->near != 0u;
    __global const ox_link* link = links + p;
    const bool remembered = link->pose != OX_NONE;
    bool known = false;
    uint category[2] = {OX_CATEGORY_HIGH, OX_CATEGORY_HIGH};
    if (near) {
      __global ox_relative_pose* now = poses + 2u * link->pose + parity;
      __global ox_relative_pose* before = poses + 2u * link->pose + (1u - parity);
      known = remembered && link->known != 0u && before->pass == pass - 1u;
      pair->displacement[0] = INFINITY;
      pair->displacement[1] = INFINITY;
      if (known) ox_displace(pair, before, mesh_a, mesh_b);
      category[0] = ox_category(pair, 0u, mesh_a, mesh_b, displacement_limit);
      category[1] = ox_category(pair, 1u, mesh_b, mesh_a, displacement_limit);
      const bool both_small = category[0] == OX_CATEGORY_SMALL && category[1] == OX_CATEGORY_SMALL;
      // Temporal data that are complete after every pass are as good as the last pose. Where
      // vertices without them are dropped, that is only so after the pair was last cast in full.
      const bool paper = (modes & OX_MODE_PAPER) != 0u;
      if (paper && !both_small && category[0] != OX_CATEGORY_DEFORMABLE)
        category[0] = category[1] = OX_CATEGORY_HIGH;
      if (remembered) {
        if (paper && both_small) {
          *now = *before;
          now->pass = pass;
        } else {
          ox_store_pose(pair, pass, now);
        }
      }
    }
    if (!near && is_dense == 0u) continue;

    uint place = is_dense != 0u ? dense_first[p] : 0u;
    for (uint side = 0u; side < 2u; ++side) {
      __global const ox_mesh* source = side == 0u ? mesh_a : mesh_b;
      __global const ox_mesh* target = side == 0u ? mesh_b : mesh_a;
      for (uint k = 0u; k < source->chunk_count; ++k) {
        const uint chunk = source->chunk_first + k;
        const bool keep = near && ox_keep_chunk(pair, side, target, chunks + chunk);
        uint task_index;
        if (is_dense != 0u) {
          task_index = place++;
          tasks[task_index].chunk = OX_NONE;
        }
        if (!keep) continue;
        if (is_dense == 0u) task_index = ox_append(&scene, category[side]);
        if (task_index == OX_NONE) continue;
        __global ox_chunk_task* task = tasks + task_index;
        task->pair_side = p << 1 | side;
        task->chunk = chunk;
        task->category = category[side] | (remembered ? OX_CATEGORY_REMEMBERED : 0u);
        task->previous = OX_NONE;
        if (!remembered) continue;
        __global ox_directory_entry* entry = directory + 2u * (link->directory[side] + k);
        if (known && entry[1u - parity].pass == pass - 1u)
          task->previous = entry[1u - parity].block;
        entry[parity].block = task_index;
        entry[parity].pass = pass;
      }
    }
  }
}
