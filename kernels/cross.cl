// SPDX-License-Identifier: BSD-3-Clause
// Cross: where do the edges of either of two meshlets cross the triangles of the other? In general
// position two surfaces intersect exactly where an edge of one crosses a face of the other.
//
// in    meshlet_pairs, pairs, meshes, meshlets
// out   crossings; found: those of each side that is flooded, one after the other
// item  1 pair of meshlets (grid-stride), an edge against a vector of triangles at a time; with
//       OX_LANES_ARE_ITEMS one block of lanes (lib/lanes.h) of one of its sides: on a GPU one
//       triangle against the edges of the other meshlet, its neighbours beside it
// may overflow: OX_LIST_CROSSINGS
#include "lib/cross.h"

static void ox_cross_pairs(const ox_scene* scene) {
  const uint count = ox_length(scene, OX_LIST_MESHLET_PAIRS);
#ifdef OX_LANES_ARE_ITEMS
  const uint per_pair = 2u * OX_BLOCKS;
  const ulong items = (ulong)count * per_pair;
  for (ulong i = scene->item; i < items; i += scene->item_count) {
    const ox_meshlet_pair both = scene->meshlet_pairs[i / per_pair];
    const uint side = (uint)(i / OX_BLOCKS) % 2u;
    const uint block = (uint)(i % OX_BLOCKS);
    const ox_block_range blocks = {block, block + 1u};
    ox_placed_meshlets placed;
    placed.pair = OX_NONE;
    ox_cross_sides(scene, &both, side, side + 1u, blocks, &placed);
  }
#else
  ox_placed_meshlets placed;
  placed.pair = OX_NONE;
  for (uint i = scene->item; i < count; i += scene->item_count) {
    const ox_meshlet_pair both = scene->meshlet_pairs[i];
    ox_cross_meshlets(scene, &both, &placed);
  }
#endif
}

__kernel void cross_meshlets(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_cross_pairs(&scene);
}
