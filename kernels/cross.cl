// SPDX-License-Identifier: BSD-3-Clause
// Cross: where do the edges of either of two meshlets cross the triangles of the other? In general
// position two surfaces intersect exactly where an edge of one crosses a face of the other.
//
// in    meshlet_pairs, pairs, meshes, meshlets
// out   crossings; found: those of each side that is flooded, one after the other
// item  1 pair of meshlets (grid-stride); an edge against sixteen triangles at a time
// may overflow: OX_LIST_CROSSINGS
#include "contacts/cross.h"

__kernel void cross_meshlets(OX_SCENE_PARAMETERS, __global const ox_meshlet_pair* meshlet_pairs,
                             __global ox_edge_crossing* crossings) {
  const ox_scene scene = OX_SCENE;
  const uint count = ox_length(&scene, OX_LIST_MESHLET_PAIRS);
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < count; i += stride) {
    const ox_meshlet_pair both = meshlet_pairs[i];
    ox_cross_meshlets(&scene, crossings, &both);
  }
}
