// SPDX-License-Identifier: BSD-3-Clause
// Cull: which meshlets of one mesh of a pair can meet the other mesh? Of that which has more of
// them, so that there is work for many; the other is searched by each of them (match.cl).
//
// in    pairs, meshes, meshlet_nodes
// out   tasks
// item  1 pair (grid-stride)
// may overflow: OX_LIST_MESHLETS
#include "lib/meshlet.h"

typedef struct {
  uint count;
  uint meshlet[OX_MOST_AT_ONCE];
} ox_kept_meshlets;

static void ox_store_meshlets(const ox_scene* scene, uint pair_side, ox_kept_meshlets* kept,
                              __global ox_meshlet_task* tasks) {
  uint stored;
  const uint first = ox_append_many(scene, OX_LIST_MESHLETS, kept->count, &stored);
  for (uint i = 0u; i < stored; ++i) {
    tasks[first + i].pair_side = pair_side;
    tasks[first + i].meshlet = kept->meshlet[i];
  }
  kept->count = 0u;
}

static void ox_cull(const ox_scene* scene, __global ox_meshlet_task* tasks) {
  for (uint p = scene->pair_first + scene->item; p < scene->pair_end; p += scene->item_count) {
    __global const ox_pair* pair = scene->pairs + p;
    if (pair->near == 0u) continue;
    const uint side =
        scene->meshes[pair->mesh[1]].meshlet_count > scene->meshes[pair->mesh[0]].meshlet_count
            ? 1u
            : 0u;
    __global const ox_mesh* source = scene->meshes + pair->mesh[side];
    __global const ox_mesh* target = scene->meshes + pair->mesh[1u - side];
    const float margin = pair->margin;
    const float3 middle = vload3(0, target->box_centre);
    const float3 half_size = vload3(0, target->box_half);
    // The box of the target in the frame of the source: cheaper to ask, and says less.
    const float3 there = ox_transform(pair, 1u - side, middle);
    const float3 reach = ox_rotate_extents(pair, 1u - side, half_size) + margin;
    ox_box box;
    box.lo = there - reach;
    box.hi = there + reach;
    ox_kept_meshlets kept;
    kept.count = 0u;
    ox_box_walk walk = ox_begin_box_walk(source);
    while (walk.count != 0u) {
      const uint child = walk.child[--walk.count];
      if ((child & OX_CHILD_MESHLET) != 0u) {
        kept.meshlet[kept.count++] = source->meshlet_first + (child >> 1);
        if (kept.count == OX_MOST_AT_ONCE) ox_store_meshlets(scene, p << 1 | side, &kept, tasks);
        continue;
      }
      __global const ox_meshlet_node* node =
          scene->surfaces.nodes + source->meshlet_node_first + (child >> 1);
      for (uint first = 0u; first < node->count; first += OX_VECTOR_WIDTH) {
        uint met = ox_children_in_box(&box, node, first / OX_VECTOR_WIDTH);
        for (; met != 0u; met &= met - 1u) {
          const uint k = first + ox_lowest(met);
          const float3 lo = (float3)(node->lo[0][k], node->lo[1][k], node->lo[2][k]);
          const float3 hi = (float3)(node->hi[0][k], node->hi[1][k], node->hi[2][k]);
          const float3 d = fabs(ox_transform(pair, side, 0.5f * (lo + hi)) - middle);
          const float3 limit = ox_rotate_extents(pair, side, 0.5f * (hi - lo)) + half_size + margin;
          if (d.x > limit.x || d.y > limit.y || d.z > limit.z) continue;
          walk.child[walk.count++] = node->child[k];
        }
      }
    }
    if (kept.count != 0u) ox_store_meshlets(scene, p << 1 | side, &kept, tasks);
  }
}

__kernel void cull(OX_SCENE_PARAMETERS, __global ox_meshlet_task* tasks) {
  const ox_scene scene = OX_SCENE;
  ox_cull(&scene, tasks);
}
