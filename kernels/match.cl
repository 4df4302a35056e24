// SPDX-License-Identifier: BSD-3-Clause
// Match: which meshlets of the other mesh can this one meet?
//
// in    meshlet_tasks, pairs, meshes, meshlets, meshlet_nodes
// out   meshlet_pairs; what cross.cl puts out, of what these have no room for: boxes
//       may overlap by the million where next to nothing crosses, so their list grows with what is
//       predicted and no further, and what it cannot take is crossed at once (cross.cl)
// item  1 meshlet of the list (grid-stride)
// may overflow: OX_LIST_CROSSINGS; OX_LIST_MESHLET_PAIRS, without loss
#include "lib/cross.h"

typedef struct {
  uint count;
  uint meshlet[OX_MOST_AT_ONCE];  // of the other mesh
} ox_met_meshlets;

static void ox_store_pairs(const ox_scene* scene, const ox_meshlet_task* task,
                           ox_met_meshlets* met) {
  const uint side = task->pair_side & 1u;
  ox_placed_meshlets placed;
  placed.pair = OX_NONE;
  uint stored;
  const uint first = ox_append_many(scene, OX_LIST_MESHLET_PAIRS, met->count, &stored);
  for (uint i = 0u; i < met->count; ++i) {
    ox_meshlet_pair both;
    both.pair = task->pair_side >> 1;
    both.meshlet[side] = task->meshlet;
    both.meshlet[1u - side] = met->meshlet[i];
    both.padding = 0u;
    if (i < stored)
      scene->meshlet_pairs[first + i] = both;
    else
      ox_cross_meshlets(scene, &both, &placed);
  }
  met->count = 0u;
}

static void ox_match(const ox_scene* scene) {
  const uint count = ox_length(scene, OX_LIST_MESHLETS);
  for (uint i = scene->item; i < count; i += scene->item_count) {
    const ox_meshlet_task task = scene->meshlet_tasks[i];
    const uint side = task.pair_side & 1u;
    __global const ox_pair* pair = scene->pairs + (task.pair_side >> 1);
    __global const ox_mesh* target = scene->meshes + pair->mesh[1u - side];
    const ox_box box =
        ox_box_there(pair, side, scene->surfaces.meshlets + task.meshlet, pair->margin);
    const ox_slab slab =
        ox_slab_there(pair, side, scene->surfaces.meshlets + task.meshlet, pair->margin);
    ox_met_meshlets met;
    met.count = 0u;
    ox_box_walk walk = ox_begin_box_walk(target);
    while (walk.count != 0u) {
      const uint child = walk.child[--walk.count];
      if ((child & OX_CHILD_MESHLET) == 0u) {
        __global const ox_meshlet_node* node =
            scene->surfaces.nodes + target->meshlet_node_first + (child >> 1);
        for (uint first = 0u; first < node->count; first += OX_VECTOR_WIDTH) {
          const uint block = first / OX_VECTOR_WIDTH;
          uint children = ox_children_in_box(&box, node, block);
          if (children != 0u) children &= ox_children_in_slab(&slab, node, block);
          for (; children != 0u; children &= children - 1u)
            walk.child[walk.count++] = node->child[first + ox_lowest(children)];
        }
        continue;
      }
      met.meshlet[met.count++] = target->meshlet_first + (child >> 1);
      if (met.count == OX_MOST_AT_ONCE) ox_store_pairs(scene, &task, &met);
    }
    if (met.count != 0u) ox_store_pairs(scene, &task, &met);
  }
}

__kernel void match(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_match(&scene);
}
