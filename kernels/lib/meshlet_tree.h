// SPDX-License-Identifier: BSD-3-Clause
// Going through the tree over the meshlets of a mesh (mesh/meshlet_tree.h), all children of a
// node asked at a time: along a ray, or through a box. Device only.
#ifndef ODE_EXT_KERNELS_LIB_MESHLET_TREE_H
#define ODE_EXT_KERNELS_LIB_MESHLET_TREE_H

#include "lib/lanes.h"
#include "lib/ray_triangle.h"

typedef struct {
  float3 lo, hi;
} ox_box;

// Children still to be gone through, the next one last; no tree has more that wait.
typedef struct {
  uint child[OX_TREE_STACK];
  uint count;
} ox_box_walk;

// The nearer to the start of the ray, the later in the list, of one node's.
typedef struct {
  uint child[OX_TREE_STACK];
  float entry[OX_TREE_STACK];  // [m] along the ray, of its box
  uint count;
} ox_ray_walk;

static inline bool ox_has_tree(__global const ox_mesh* mesh) {
  return mesh->meshlet_node_count != 0u;
}

static inline ox_ray_walk ox_begin_ray_walk(__global const ox_mesh* mesh) {
  ox_ray_walk walk;
  walk.count = ox_has_tree(mesh) ? 1u : 0u;
  walk.child[0] = OX_TREE_ROOT;
  walk.entry[0] = -INFINITY;
  return walk;
}

static inline ox_box_walk ox_begin_box_walk(__global const ox_mesh* mesh) {
  ox_box_walk walk;
  walk.count = ox_has_tree(mesh) ? 1u : 0u;
  walk.child[0] = OX_TREE_ROOT;
  return walk;
}

// A bit for each child of a block that has one at least. Their boxes are turned inside out where
// there is none, but what is not finite would meet those too.
static inline uint ox_present_children(__global const ox_meshlet_node* node, uint block) {
  return ox_present_lanes(node->count, block);
}

// Of the children of a node that a walk goes on to, the one with the greatest rating.
typedef struct {
  uint index;  // among those of the walk; OX_NONE: there is none yet
  float rating;
} ox_best_child;

// Puts the children of a block that `wanted` has a bit for on a walk.
static inline void ox_push_children(__global const ox_meshlet_node* node, uint block, uint wanted,
                                    const ox_floats* ratings, ox_box_walk* walk,
                                    ox_best_child* best) {
  ox_lane_floats rating_of;
  ox_keep_lanes(ratings, &rating_of);
  for (; wanted != 0u; wanted &= wanted - 1u) {
    const uint lane = ox_lowest(wanted);
    const float rating = ox_lane(&rating_of, lane);
    if (best->index == OX_NONE || rating > best->rating) {
      best->index = walk->count;
      best->rating = rating;
    }
    walk->child[walk->count++] = node->child[OX_VECTOR_WIDTH * block + lane];
  }
}

// What the best child holds spares most of the others: it is the next.
static inline void ox_put_best_last(ox_box_walk* walk, const ox_best_child* best) {
  if (best->index == OX_NONE) return;
  const uint child = walk->child[best->index];
  walk->child[best->index] = walk->child[walk->count - 1u];
  walk->child[walk->count - 1u] = child;
}

// A block of the children whose boxes a ray passes between `from` and `limit` [m], a bit for each;
// entry [m]: from where on.
static inline uint ox_entered_children(const ox_cast* cast, __global const ox_meshlet_node* node,
                                       uint block, float from, float limit, ox_lane_floats* entry) {
  const float3 inverse = cast->inverse;
  const float3 origin = cast->start;
  const bool turned_x = inverse.x < 0.0f;
  const bool turned_y = inverse.y < 0.0f;
  const bool turned_z = inverse.z < 0.0f;
  const ox_floats near_x =
      (ox_load(block, turned_x ? node->hi[0] : node->lo[0]) - origin.x) * inverse.x;
  const ox_floats near_y =
      (ox_load(block, turned_y ? node->hi[1] : node->lo[1]) - origin.y) * inverse.y;
  const ox_floats near_z =
      (ox_load(block, turned_z ? node->hi[2] : node->lo[2]) - origin.z) * inverse.z;
  const ox_floats far_x =
      (ox_load(block, turned_x ? node->lo[0] : node->hi[0]) - origin.x) * inverse.x;
  const ox_floats far_y =
      (ox_load(block, turned_y ? node->lo[1] : node->hi[1]) - origin.y) * inverse.y;
  const ox_floats far_z =
      (ox_load(block, turned_z ? node->lo[2] : node->hi[2]) - origin.z) * inverse.z;
  const ox_floats first = (ox_floats)(from);
  const ox_floats last = (ox_floats)(limit);
  const ox_floats enter_xy = OX_GREATER(near_x, near_y);
  const ox_floats enter_z = OX_GREATER(near_z, first);
  const ox_floats enter = OX_GREATER(enter_xy, enter_z);
  const ox_floats leave_xy = OX_LESSER(far_x, far_y);
  const ox_floats leave_z = OX_LESSER(far_z, last);
  const ox_floats leave = OX_LESSER(leave_xy, leave_z);
  ox_keep_lanes(&enter, entry);
  const ox_ints met = enter <= leave;
  return ox_mask_of(&met) & ox_present_children(node, block);
}

// The next meshlet, over all meshes, whose box the ray passes between `from` and `limit`; OX_NONE:
// there are no more. *work: boxes asked.
static inline uint ox_next_on_ray(ox_ray_walk* walk, const ox_cast* cast,
                                  __global const ox_mesh* mesh,
                                  __global const ox_meshlet_node* all_nodes, float from,
                                  float limit, uint* work) {
  while (walk->count != 0u) {
    const uint child = walk->child[--walk->count];
    if (walk->entry[walk->count] > limit) continue;
    if ((child & OX_CHILD_MESHLET) != 0u) return mesh->meshlet_first + (child >> 1);
    __global const ox_meshlet_node* node = all_nodes + mesh->meshlet_node_first + (child >> 1);
    *work += node->count;
    const uint begin = walk->count;
    for (uint first = 0u; first < node->count; first += OX_VECTOR_WIDTH) {
      ox_lane_floats entry_of;
      uint met = ox_entered_children(cast, node, first / OX_VECTOR_WIDTH, from, limit, &entry_of);
      for (; met != 0u; met &= met - 1u) {
        const uint k = ox_lowest(met);
        const float entry = ox_lane(&entry_of, k);
        uint place = walk->count++;
        for (; place > begin && walk->entry[place - 1u] < entry; --place) {
          walk->child[place] = walk->child[place - 1u];
          walk->entry[place] = walk->entry[place - 1u];
        }
        walk->child[place] = node->child[first + k];
        walk->entry[place] = entry;
      }
    }
  }
  return OX_NONE;
}

// A block of the children whose boxes meet a box, a bit for each.
static inline uint ox_children_in_box(const ox_box* box, __global const ox_meshlet_node* node,
                                      uint block) {
  const ox_ints met =
      (ox_load(block, node->lo[0]) <= box->hi.x) & (ox_load(block, node->hi[0]) >= box->lo.x) &
      (ox_load(block, node->lo[1]) <= box->hi.y) & (ox_load(block, node->hi[1]) >= box->lo.y) &
      (ox_load(block, node->lo[2]) <= box->hi.z) & (ox_load(block, node->hi[2]) >= box->lo.z);
  return ox_mask_of(&met) & ox_present_children(node, block);
}

// The next meshlet, over all meshes, whose box meets a box; OX_NONE: there are no more.
static inline uint ox_next_in_box(ox_box_walk* walk, const ox_box* box,
                                  __global const ox_mesh* mesh,
                                  __global const ox_meshlet_node* all_nodes) {
  while (walk->count != 0u) {
    const uint child = walk->child[--walk->count];
    if ((child & OX_CHILD_MESHLET) != 0u) return mesh->meshlet_first + (child >> 1);
    __global const ox_meshlet_node* node = all_nodes + mesh->meshlet_node_first + (child >> 1);
    for (uint first = 0u; first < node->count; first += OX_VECTOR_WIDTH) {
      uint met = ox_children_in_box(box, node, first / OX_VECTOR_WIDTH);
      for (; met != 0u; met &= met - 1u)
        walk->child[walk->count++] = node->child[first + ox_lowest(met)];
    }
  }
  return OX_NONE;
}

// The box of mesh 1 - `side` of a pair in the frame of mesh `side`.
static inline ox_box ox_target_box(__global const ox_pair* pair, uint side,
                                   __global const ox_mesh* target) {
  const float3 middle = ox_transform(pair, 1u - side, vload3(0, target->box_centre));
  const float3 size =
      ox_rotate_extents(pair, 1u - side, vload3(0, target->box_half)) + pair->margin;
  const ox_box box = {middle - size, middle + size};
  return box;
}

// Two planes, and what lies between them.
typedef struct {
  float3 normal;
  float lo, hi;  // [m] along it
} ox_slab;

static inline bool ox_box_meets_slab(const ox_box* box, const ox_slab* slab) {
  const float3 n = 0.5f * slab->normal;
  const float middle = ox_dot(n, box->lo + box->hi);
  const float reach = ox_dot(fabs(n), box->hi - box->lo);
  return middle - reach <= slab->hi && middle + reach >= slab->lo;
}

// A block of the children whose boxes meet a slab, a bit for each.
static inline uint ox_children_in_slab(const ox_slab* slab, __global const ox_meshlet_node* node,
                                       uint block) {
  const float3 n = 0.5f * slab->normal;
  const float3 size = fabs(n);
  const ox_floats lo_x = ox_load(block, node->lo[0]), hi_x = ox_load(block, node->hi[0]);
  const ox_floats lo_y = ox_load(block, node->lo[1]), hi_y = ox_load(block, node->hi[1]);
  const ox_floats lo_z = ox_load(block, node->lo[2]), hi_z = ox_load(block, node->hi[2]);
  const ox_floats middle = n.x * (lo_x + hi_x) + n.y * (lo_y + hi_y) + n.z * (lo_z + hi_z);
  const ox_floats reach = size.x * (hi_x - lo_x) + size.y * (hi_y - lo_y) + size.z * (hi_z - lo_z);
  const ox_ints met = (middle - reach <= slab->hi) & (middle + reach >= slab->lo);
  return ox_mask_of(&met) & ox_present_children(node, block);
}

#endif
