// SPDX-License-Identifier: BSD-3-Clause
// Cull: which meshlets of one mesh of a pair can meet the other mesh, and which subtrees of it? Of
// that which has more of them, so that there is work for many; each of them searches its subtrees
// (match.cl).
//
// in    pairs, meshes, meshlet_nodes; of coarse meshes triangles and meshlets
// out   meshlet_tasks
// item  1 pair (grid-stride); of a work-group, where lanes are one (lib/group.h)
// may overflow: OX_LIST_MESHLETS
#include "lib/coarse_slabs.h"
#include "lib/meshlet.h"

typedef struct {
  uint pair_side;
  uint count;
  uint meshlet[OX_MOST_AT_ONCE];
  uint subtree[OX_MOST_AT_ONCE];
} ox_kept_meshlets;

static void ox_store_meshlets(const ox_scene* scene, ox_kept_meshlets* kept) {
  uint stored;
  const uint first = ox_append_many(scene, OX_LIST_MESHLETS, kept->count, &stored);
  for (uint i = 0u; i < stored; ++i) {
    __global ox_meshlet_task* task = scene->meshlet_tasks + first + i;
    task->pair_side = kept->pair_side;
    task->meshlet = kept->meshlet[i];
    task->subtree = kept->subtree[i];
  }
  kept->count = 0u;
}

// A block of children of a node of the source, their boxes in the frame of the target.
typedef struct {
  ox_lane_floats lo[3];
  ox_lane_floats hi[3];
  uint met;                       // a bit for each whose box there meets that of the target
  uint meshlets;                  // for each of these that is a meshlet
  uint meshlet[OX_VECTOR_WIDTH];  // over all meshes, of these
} ox_children_there;

// Those of the block that `asked` has a bit for.
static void ox_place_children(__global const ox_pair* pair, uint side,
                              __global const ox_mesh* source, __global const ox_mesh* target,
                              __global const ox_meshlet_node* node, uint block, uint asked,
                              ox_children_there* there) {
  const ox_floats lo_x = ox_load(block, node->lo[0]), hi_x = ox_load(block, node->hi[0]);
  const ox_floats lo_y = ox_load(block, node->lo[1]), hi_y = ox_load(block, node->hi[1]);
  const ox_floats lo_z = ox_load(block, node->lo[2]), hi_z = ox_load(block, node->hi[2]);
  const ox_floats x = 0.5f * (lo_x + hi_x), half_x = 0.5f * (hi_x - lo_x);
  const ox_floats y = 0.5f * (lo_y + hi_y), half_y = 0.5f * (hi_y - lo_y);
  const ox_floats z = 0.5f * (lo_z + hi_z), half_z = 0.5f * (hi_z - lo_z);
  there->met = asked;
  for (uint axis = 0u; axis < 3u; ++axis) {
    __global const float* r = pair->rotation[side] + 3u * axis;
    const ox_floats middle = r[0] * x + r[1] * y + r[2] * z + pair->offset[side][axis];
    const ox_floats size =
        fabs(r[0]) * half_x + fabs(r[1]) * half_y + fabs(r[2]) * half_z + pair->margin;
    const ox_ints meets = fabs(middle - target->box_centre[axis]) <= size + target->box_half[axis];
    there->met &= ox_mask_of(&meets);
    const ox_floats lo = middle - size;
    const ox_floats hi = middle + size;
    ox_keep_lanes(&lo, there->lo + axis);
    ox_keep_lanes(&hi, there->hi + axis);
  }
  there->meshlets = 0u;
  for (uint left = there->met; left != 0u; left &= left - 1u) {
    const uint k = ox_lowest(left);
    const uint child = node->child[OX_VECTOR_WIDTH * block + k];
    if ((child & OX_CHILD_MESHLET) == 0u) continue;
    there->meshlets |= 1u << k;
    there->meshlet[k] = source->meshlet_first + (child >> 1);
  }
}

// A bit for each of the children whose box there meets another.
static uint ox_children_meeting(const ox_children_there* there, float3 lo, float3 hi) {
  ox_floats lo_x, lo_y, lo_z, hi_x, hi_y, hi_z;
  ox_kept_lanes(there->lo, &lo_x);
  ox_kept_lanes(there->lo + 1, &lo_y);
  ox_kept_lanes(there->lo + 2, &lo_z);
  ox_kept_lanes(there->hi, &hi_x);
  ox_kept_lanes(there->hi + 1, &hi_y);
  ox_kept_lanes(there->hi + 2, &hi_z);
  const ox_ints met = (lo_x <= hi.x) & (hi_x >= lo.x) & (lo_y <= hi.y) & (hi_y >= lo.y) &
                      (lo_z <= hi.z) & (hi_z >= lo.z);
  return ox_mask_of(&met);
}

// The box about the boxes of some.
static ox_box ox_box_about(const ox_children_there* there, uint children) {
  ox_box box = {(float3)(INFINITY), (float3)(-INFINITY)};
  for (; children != 0u; children &= children - 1u) {
    const uint k = ox_lowest(children);
    const float3 lo =
        (float3)(ox_lane(there->lo, k), ox_lane(there->lo + 1, k), ox_lane(there->lo + 2, k));
    const float3 hi =
        (float3)(ox_lane(there->hi, k), ox_lane(there->hi + 1, k), ox_lane(there->hi + 2, k));
    box.lo = OX_LESSER(box.lo, lo);
    box.hi = OX_GREATER(box.hi, hi);
  }
  return box;
}

// Subtrees of the target, each by its root as a child of another node, and the children of a block
// that meet them, a bit for each: those still to be gone through, and those that meshlets met.
typedef struct {
  uint subtree[OX_TREE_STACK];
  uint children[OX_TREE_STACK];
  uint count;
} ox_subtree_walk;

typedef struct {
  uint subtree[OX_MOST_SUBTREES];
  uint children[OX_MOST_SUBTREES];
  uint count;
} ox_met_subtrees;

// Keeps those that are meshlets, each with its subtrees one after the other.
static void ox_keep_meshlets(const ox_scene* scene, const ox_children_there* there,
                             const ox_met_subtrees* subtrees, ox_kept_meshlets* kept) {
  for (uint left = there->meshlets; left != 0u; left &= left - 1u) {
    const uint k = ox_lowest(left);
    for (uint i = 0u; i < subtrees->count; ++i) {
      if ((subtrees->children[i] >> k & 1u) == 0u) continue;
      kept->meshlet[kept->count] = there->meshlet[k];
      kept->subtree[kept->count++] = subtrees->subtree[i];
      if (kept->count == OX_MOST_AT_ONCE) ox_store_meshlets(scene, kept);
    }
  }
}

// So few meshlets of a block are not worth a way down here (docs/performance.md): they go all of it
// in match.cl, as do those that together meet more subtrees than OX_MOST_SUBTREES. So does each
// where a block is one child, on a GPU without groups: match has an item for each.
#define OX_FEW_MESHLETS 2u

// Goes down the tree over the target with all children of a block at once. A child that is a
// meshlet is kept with each node at which it first meets a meshlet's box; returned is a bit for
// each other child that meets one anywhere. A box over hills is mostly empty: many meshlets at once
// are asked for what is in it.
static uint ox_meet_target(const ox_scene* scene, __global const ox_mesh* target,
                           const ox_children_there* there, ox_kept_meshlets* kept) {
  ox_met_subtrees found;
  found.count = 0u;
  uint done = 0u;  // nodes that met a meshlet, meshlets listed with all of the target
  if (popcount(there->meshlets) <= OX_FEW_MESHLETS) {
    found.subtree[0] = OX_TREE_ROOT;
    found.children[0] = there->meshlets;
    found.count = 1u;
    done = there->meshlets;
  }
  const ox_box all = ox_box_about(there, there->met & ~done);
  ox_subtree_walk walk;
  walk.count = 1u;
  walk.subtree[0] = OX_TREE_ROOT;
  walk.children[0] = there->met;
  while (walk.count != 0u) {
    uint subtree = walk.subtree[--walk.count];
    const uint children = walk.children[walk.count] & ~done;
    if (children == 0u) continue;
    __global const ox_meshlet_node* node =
        scene->surfaces.nodes + target->meshlet_node_first + (subtree >> 1);
    const uint begin = walk.count;
    uint ended = 0u;  // there: they have met a meshlet
    for (uint first = 0u; first < node->count; first += OX_VECTOR_WIDTH) {
      uint asked = ox_children_in_box(&all, node, first / OX_VECTOR_WIDTH);
      for (; asked != 0u; asked &= asked - 1u) {
        const uint k = first + ox_lowest(asked);
        const float3 lo = (float3)(node->lo[0][k], node->lo[1][k], node->lo[2][k]);
        const float3 hi = (float3)(node->hi[0][k], node->hi[1][k], node->hi[2][k]);
        const uint meeting = children & ox_children_meeting(there, lo, hi);
        if (meeting == 0u) continue;
        if ((node->child[k] & OX_CHILD_MESHLET) != 0u) {
          ended |= meeting;
        } else {
          walk.subtree[walk.count] = node->child[k];
          walk.children[walk.count++] = meeting;
        }
      }
    }
    if (ended == 0u) continue;
    done |= ended & ~there->meshlets;
    for (uint i = begin; i < walk.count; ++i) walk.children[i] &= ~ended;
    ended &= there->meshlets;
    if (ended == 0u) continue;
    if (found.count == OX_MOST_SUBTREES) {
      subtree = OX_TREE_ROOT;
      ended = there->meshlets;
      done |= ended;
      found.count = 0u;
    }
    found.subtree[found.count] = subtree;
    found.children[found.count++] = ended;
  }
  ox_keep_meshlets(scene, there, &found, kept);
  return done & ~there->meshlets;
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
    if (!ox_has_tree(target)) continue;
    const ox_box box = ox_target_box(pair, side, target);
    ox_coarse_slabs slabs;
    ox_find_coarse_slabs(scene, pair, side, &slabs);
    ox_kept_meshlets kept;
    kept.pair_side = p << 1 | side;
    kept.count = 0u;
    ox_box_walk walk = ox_begin_box_walk(source);
    while (walk.count != 0u) {
      const uint child = walk.child[--walk.count];
      __global const ox_meshlet_node* node =
          scene->surfaces.nodes + source->meshlet_node_first + (child >> 1);
      for (uint first = 0u; first < node->count; first += OX_VECTOR_WIDTH) {
        const uint block = first / OX_VECTOR_WIDTH;
        uint in_box = ox_children_in_box(&box, node, block);
        if (in_box != 0u) in_box = ox_children_in_slabs(&slabs, node, block, in_box);
        if (in_box == 0u) continue;
        ox_children_there there;
        ox_place_children(pair, side, source, target, node, block, in_box, &there);
        if (there.met == 0u) continue;
        uint nodes = ox_meet_target(scene, target, &there, &kept);
        for (; nodes != 0u; nodes &= nodes - 1u)
          walk.child[walk.count++] = node->child[first + ox_lowest(nodes)];
      }
    }
    if (kept.count != 0u) ox_store_meshlets(scene, &kept);
  }
}

__kernel void cull(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_cull(&scene);
}
