// SPDX-License-Identifier: BSD-3-Clause
// What each kernel of a batch works on: the counters and lists, the pairs, the meshes. Kernels take
// it as OX_SCENE_PARAMETERS first, and hand their functions a pointer to the ox_scene that OX_SCENE
// makes of it. Device only.
#ifndef ODE_EXT_KERNELS_LIB_SCENE_H
#define ODE_EXT_KERNELS_LIB_SCENE_H

#include "abi/types.h"

// What rays are cast against: the triangles of all meshes, their meshlets, and the trees of those.
typedef struct {
  __global const ox_triangle* triangles;
  __global const ox_meshlet* meshlets;
  __global const ox_meshlet_node* nodes;
} ox_surfaces;

typedef struct {
  __global volatile uint* counters;
  __global const ox_list* lists;
  uint modes;                 // OX_MODE_...
  uint pair_first, pair_end;  // of the pairs that are looked at
  uint item, item_count;      // of the work-items that do
  bool alone;                 // there is one, and what it changes is no other's (lib/atomics.h)
  __global volatile uint* contact_count;
  __global ox_pair* pairs;
  __global ox_found* found;  // of each pair
  __global const ox_mesh* meshes;
  __global const ox_chunk* chunks;
  __global const ox_vertex* vertices;
  __global const ox_edge* edges;
  __global const uint* ring_starts;
  __global const ox_neighbour* rings;
  __global const uint* facets;
  ox_surfaces surfaces;
} ox_scene;

// In the order of BatchData::launch (search/batch_data.h). `pairs` are written by the pair step,
// and by paper/chunk_tasks.cl.
#define OX_SCENE_PARAMETERS                                                                     \
  __global volatile uint *counters, __global const ox_list *lists, uint modes, uint pair_count, \
      __global ox_pair *pairs, __global ox_found *found, __global const ox_mesh *meshes,        \
      __global const ox_chunk *chunks, __global const ox_vertex *vertices,                      \
      __global const ox_edge *edges, __global const uint *ring_starts,                          \
      __global const ox_neighbour *rings, __global const uint *facets,                          \
      __global const ox_triangle *triangles, __global const ox_meshlet *meshlets,               \
      __global const ox_meshlet_node *meshlet_nodes

#define OX_SCENE                                                                              \
  {                                                                                           \
    counters, lists, modes, 0u, pair_count, (uint)get_global_id(0), (uint)get_global_size(0), \
        false, counters + OX_LIST_CONTACTS *OX_COUNTER_STRIDE, pairs, found, meshes, chunks,  \
        vertices, edges, ring_starts, rings, facets, {                                        \
      triangles, meshlets, meshlet_nodes                                                      \
    }                                                                                         \
  }

#endif
