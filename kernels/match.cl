// SPDX-License-Identifier: BSD-3-Clause
// Match: which meshlets of a subtree of the other mesh can this one meet?
//
// in    meshlet_tasks, pairs, meshes, meshlets, meshlet_nodes
// out   meshlet_pairs; what cross.cl puts out, of what these have no room for: boxes
//       may overlap by the million where next to nothing crosses, so their list grows with what is
//       predicted and no further, and what it cannot take is crossed at once (cross.cl)
// item  1 meshlet of the list and one of its subtrees (grid-stride)
// may overflow: OX_LIST_CROSSINGS; OX_LIST_MESHLET_PAIRS, without loss
#include "lib/cross.h"

// A meshlet in the frame of the other mesh of its pair, and what it met of that.
typedef struct {
  uint pair_side;
  uint meshlet;  // OX_NONE: none yet
  ox_box box;
  ox_slab slab;
  uint count;
  uint met[OX_MOST_AT_ONCE];
} ox_matched_meshlet;

static void ox_store_pairs(const ox_scene* scene, ox_matched_meshlet* one) {
  const uint side = one->pair_side & 1u;
  ox_placed_meshlets placed;
  placed.pair = OX_NONE;
  uint stored;
  const uint first = ox_append_many(scene, OX_LIST_MESHLET_PAIRS, one->count, &stored);
  for (uint i = 0u; i < one->count; ++i) {
    ox_meshlet_pair both;
    both.pair = one->pair_side >> 1;
    both.meshlet[side] = one->meshlet;
    both.meshlet[1u - side] = one->met[i];
    both.padding = 0u;
    if (i < stored)
      scene->meshlet_pairs[first + i] = both;
    else
      ox_cross_meshlets(scene, &both, &placed);
  }
  one->count = 0u;
}

static void ox_match_subtree(const ox_scene* scene, uint subtree, ox_matched_meshlet* one) {
  const uint side = one->pair_side & 1u;
  __global const ox_pair* pair = scene->pairs + (one->pair_side >> 1);
  __global const ox_mesh* target = scene->meshes + pair->mesh[1u - side];
  ox_box_walk walk;
  walk.child[0] = subtree;
  walk.count = 1u;
  while (walk.count != 0u) {
    const uint parent = walk.child[--walk.count];
    __global const ox_meshlet_node* node =
        scene->surfaces.nodes + target->meshlet_node_first + (parent >> 1);
    for (uint first = 0u; first < node->count; first += OX_VECTOR_WIDTH) {
      const uint block = first / OX_VECTOR_WIDTH;
      uint children = ox_children_in_box(&one->box, node, block);
      if (children != 0u) children &= ox_children_in_slab(&one->slab, node, block);
      for (; children != 0u; children &= children - 1u) {
        const uint child = node->child[first + ox_lowest(children)];
        if ((child & OX_CHILD_MESHLET) == 0u) {
          walk.child[walk.count++] = child;
          continue;
        }
        const uint other = target->meshlet_first + (child >> 1);
        const ox_slab slab = ox_slab_of(pair, scene->surfaces.meshlets + other);
        if (!ox_box_meets_slab(&one->box, &slab)) continue;
        one->met[one->count++] = other;
        if (one->count == OX_MOST_AT_ONCE) ox_store_pairs(scene, one);
      }
    }
  }
}

static void ox_match(const ox_scene* scene) {
  const uint count = ox_length(scene, OX_LIST_MESHLETS);
  ox_matched_meshlet one;
  one.meshlet = OX_NONE;
  one.count = 0u;
  for (uint i = scene->item; i < count; i += scene->item_count) {
    const ox_meshlet_task task = scene->meshlet_tasks[i];
    // The subtrees that one meets come one after the other.
    if (task.meshlet != one.meshlet || task.pair_side != one.pair_side) {
      if (one.count != 0u) ox_store_pairs(scene, &one);
      __global const ox_pair* pair = scene->pairs + (task.pair_side >> 1);
      __global const ox_meshlet* meshlet = scene->surfaces.meshlets + task.meshlet;
      one.pair_side = task.pair_side;
      one.meshlet = task.meshlet;
      one.box = ox_box_there(pair, task.pair_side & 1u, meshlet, pair->margin);
      one.slab = ox_slab_there(pair, task.pair_side & 1u, meshlet, pair->margin);
    }
    ox_match_subtree(scene, task.subtree, &one);
  }
  if (one.count != 0u) ox_store_pairs(scene, &one);
}

__kernel void match(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_match(&scene);
}
