// SPDX-License-Identifier: BSD-3-Clause
// Cull: which meshlets of one mesh of a pair can meet the other mesh? Of that which has more of
// them, so that there is work for many; the other is searched by each of them (match.cl).
//
// in    pairs, meshes, meshlet_nodes
// out   meshlet_tasks
// item  1 pair (grid-stride)
// may overflow: OX_LIST_MESHLETS
#include "lib/meshlet.h"

typedef struct {
  uint count;
  uint meshlet[OX_MOST_AT_ONCE];
} ox_kept_meshlets;

static void ox_store_meshlets(const ox_scene* scene, uint pair_side, ox_kept_meshlets* kept) {
  uint stored;
  const uint first = ox_append_many(scene, OX_LIST_MESHLETS, kept->count, &stored);
  for (uint i = 0u; i < stored; ++i) {
    scene->meshlet_tasks[first + i].pair_side = pair_side;
    scene->meshlet_tasks[first + i].meshlet = kept->meshlet[i];
  }
  kept->count = 0u;
}

// A block of children of a node of the source, in the frame of the target.
typedef struct {
  float middle[3][OX_VECTOR_WIDTH];
  float size[3][OX_VECTOR_WIDTH];  // from there to the sides of the box about its box
} ox_children_there;

// Returns a bit for each child whose box there meets that of the target.
static uint ox_place_children(__global const ox_pair* pair, uint side,
                              __global const ox_mesh* target, __global const ox_meshlet_node* node,
                              uint block, ox_children_there* there) {
  const ox_floats lo_x = ox_load(block, node->lo[0]), hi_x = ox_load(block, node->hi[0]);
  const ox_floats lo_y = ox_load(block, node->lo[1]), hi_y = ox_load(block, node->hi[1]);
  const ox_floats lo_z = ox_load(block, node->lo[2]), hi_z = ox_load(block, node->hi[2]);
  const ox_floats x = 0.5f * (lo_x + hi_x), half_x = 0.5f * (hi_x - lo_x);
  const ox_floats y = 0.5f * (lo_y + hi_y), half_y = 0.5f * (hi_y - lo_y);
  const ox_floats z = 0.5f * (lo_z + hi_z), half_z = 0.5f * (hi_z - lo_z);
  uint met = ox_present_children(node, block);
  for (uint axis = 0u; axis < 3u; ++axis) {
    __global const float* r = pair->rotation[side] + 3u * axis;
    const ox_floats middle = r[0] * x + r[1] * y + r[2] * z + pair->offset[side][axis];
    const ox_floats size =
        fabs(r[0]) * half_x + fabs(r[1]) * half_y + fabs(r[2]) * half_z + pair->margin;
    const ox_ints meets = fabs(middle - target->box_centre[axis]) <= size + target->box_half[axis];
    met &= ox_mask_of(&meets);
    ox_store(middle, 0, there->middle[axis]);
    ox_store(size, 0, there->size[axis]);
  }
  return met;
}

static bool ox_meets_target(const ox_scene* scene, const ox_children_there* there, uint lane,
                            __global const ox_mesh* target) {
  const float3 middle =
      (float3)(there->middle[0][lane], there->middle[1][lane], there->middle[2][lane]);
  const float3 size = (float3)(there->size[0][lane], there->size[1][lane], there->size[2][lane]);
  const ox_box box = {middle - size, middle + size};
  return ox_meets_meshlets(&box, target, scene->surfaces.nodes);
}

static void ox_cull(const ox_scene* scene) {
  for (uint p = scene->pair_first + scene->item; p < scene->pair_end; p += scene->item_count) {
    __global const ox_pair* pair = scene->pairs + p;
    if (pair->near == 0u) continue;
    const uint side =
        scene->meshes[pair->mesh[1]].meshlet_count > scene->meshes[pair->mesh[0]].meshlet_count
            ? 1u
            : 0u;
    __global const ox_mesh* source = scene->meshes + pair->mesh[side];
    __global const ox_mesh* target = scene->meshes + pair->mesh[1u - side];
    const ox_box box = ox_target_box(pair, side, target);
    ox_kept_meshlets kept;
    kept.count = 0u;
    ox_box_walk walk = ox_begin_box_walk(source);
    while (walk.count != 0u) {
      const uint child = walk.child[--walk.count];
      if ((child & OX_CHILD_MESHLET) != 0u) {
        kept.meshlet[kept.count++] = source->meshlet_first + (child >> 1);
        if (kept.count == OX_MOST_AT_ONCE) ox_store_meshlets(scene, p << 1 | side, &kept);
        continue;
      }
      __global const ox_meshlet_node* node =
          scene->surfaces.nodes + source->meshlet_node_first + (child >> 1);
      for (uint first = 0u; first < node->count; first += OX_VECTOR_WIDTH) {
        const uint block = first / OX_VECTOR_WIDTH;
        uint met = ox_children_in_box(&box, node, block);
        if (met == 0u) continue;
        ox_children_there there;
        met &= ox_place_children(pair, side, target, node, block, &there);
        for (; met != 0u; met &= met - 1u) {
          const uint lane = ox_lowest(met);
          const uint next = node->child[first + lane];
          // A box over hills is mostly empty: many meshlets at once are asked for what is in it.
          if ((next & OX_CHILD_MESHLET) != 0u || ox_meets_target(scene, &there, lane, target))
            walk.child[walk.count++] = next;
        }
      }
    }
    if (kept.count != 0u) ox_store_meshlets(scene, p << 1 | side, &kept);
  }
}

__kernel void cull(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_cull(&scene);
}
