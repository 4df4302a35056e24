// SPDX-License-Identifier: BSD-3-Clause
// Cross: where do the edges of either of two meshlets cross the triangles of the other? In general
// position two surfaces intersect exactly where an edge of one crosses a face of the other.
//
// in    meshlet_pairs, pairs, meshlets
// out   crossings, and per pair their number
// item  1 pair of meshlets (grid-stride); an edge against sixteen triangles at a time
// may overflow: OX_LIST_CROSSINGS
#include "shared/cross.h"

__kernel void cross_meshlets(__global volatile uint* counters, __global const ox_list* lists,
                             __global const ox_meshlet_pair* meshlet_pairs,
                             __global const ox_pair* pairs, __global const ox_meshlet* meshlets,
                             __global volatile uint* pair_crossings,
                             __global ox_edge_crossing* crossings) {
  const uint count = ox_length(counters, lists, OX_LIST_MESHLET_PAIRS);
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < count; i += stride) {
    const ox_meshlet_pair both = meshlet_pairs[i];
    __global const ox_pair* pair = pairs + both.pair;
    __global const ox_meshlet* a = meshlets + both.meshlet[0];
    __global const ox_meshlet* b = meshlets + both.meshlet[1];
    ox_near_points near_b;  // vertices of A, in the frame of B
    ox_near_points near_a;
    if (!ox_find_near(pair, 0u, a, b, &near_b) || !ox_find_near(pair, 1u, b, a, &near_a)) continue;
    ox_cross_edges(counters, lists, both.pair << 1, pair, a, b, &near_b, pair_crossings, crossings);
    ox_cross_edges(counters, lists, both.pair << 1 | 1u, pair, b, a, &near_a, pair_crossings,
                   crossings);
  }
}
