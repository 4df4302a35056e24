// SPDX-License-Identifier: BSD-3-Clause
// Cull: which meshlets of one mesh of a pair can meet the other mesh? Of that which has more of
// them, so that there is work for many; the other is searched by each of them (match.cl).
//
// in    pairs, meshes, meshlet_nodes
// out   tasks
// item  1 pair (grid-stride)
// may overflow: OX_LIST_MESHLETS
#include "shared/meshlet.h"

__kernel void cull(__global volatile uint* counters, __global const ox_list* lists,
                   __global const ox_pair* pairs, __global const ox_mesh* meshes,
                   __global const ox_node* meshlet_nodes, uint pair_count,
                   __global ox_meshlet_task* tasks) {
  const uint stride = (uint)get_global_size(0);
  for (uint p = (uint)get_global_id(0); p < pair_count; p += stride) {
    __global const ox_pair* pair = pairs + p;
    if (pair->near == 0u) continue;
    const uint side =
        meshes[pair->mesh[1]].meshlet_count > meshes[pair->mesh[0]].meshlet_count ? 1u : 0u;
    __global const ox_mesh* source = meshes + pair->mesh[side];
    __global const ox_mesh* target = meshes + pair->mesh[1u - side];
    const float margin = ox_search_margin(pair);
    const float3 middle = vload3(0, target->box_centre);
    const float3 half_size = vload3(0, target->box_half);
    // The box of the target in the frame of the source: cheaper to ask, and says less.
    const float3 there = ox_place(pair, 1u - side, middle);
    const float3 reach = ox_turn_extents(pair, 1u - side, half_size) + margin;
    ox_box box;
    box.lo = there - reach;
    box.hi = there + reach;
    __global const ox_node* nodes = meshlet_nodes + source->meshlet_node_first;
    for (uint n = 0u; n < source->meshlet_node_count;) {
      __global const ox_node* node = nodes + n;
      n = node->skip;
      if (!ox_meets_node(&box, node)) continue;
      const float3 lo = vload3(0, node->lo);
      const float3 hi = vload3(0, node->hi);
      const float3 d = fabs(ox_place(pair, side, 0.5f * (lo + hi)) - middle);
      const float3 limit = ox_turn_extents(pair, side, 0.5f * (hi - lo)) + half_size + margin;
      if (d.x > limit.x || d.y > limit.y || d.z > limit.z) continue;
      if (node->leaf == 0u) {
        n = (uint)(node - nodes) + 1u;
        continue;
      }
      const uint slot = ox_append(counters, lists, OX_LIST_MESHLETS);
      if (slot == OX_NONE) continue;
      tasks[slot].pair_side = p << 1 | side;
      tasks[slot].meshlet = source->meshlet_first + (node->leaf >> 3);
    }
  }
}
