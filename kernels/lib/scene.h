// SPDX-License-Identifier: BSD-3-Clause
// What each kernel of a batch works on: meshes, pairs, and lists that one step fills for the next.
// Kernels take it as OX_SCENE_PARAMETERS first, and hand their functions a pointer to the ox_scene
// that OX_SCENE makes of it; which lists a kernel reads and which it writes is said at its head.
// Device only.
#ifndef ODE_EXT_KERNELS_LIB_SCENE_H
#define ODE_EXT_KERNELS_LIB_SCENE_H

#include "abi/types.h"
#include "lib/group.h"

// What becomes of crossings and hits (abi/contacts.h).
struct ox_feature;
struct ox_region;
struct ox_face;

// What rays are cast against: the triangles of all meshes, their meshlets, and the trees of those.
typedef struct {
  __global const ox_triangle* triangles;
  __global const ox_meshlet* meshlets;
  __global const ox_meshlet_node* nodes;
} ox_surfaces;

typedef struct {
  __global volatile uint* counters;
  __global const ox_list* lists;
  uint modes;                         // OX_MODE_...
  uint max_contacts, max_deformable;  // of a pair; of one with a deformable mesh, 0: all
  uint pair_first, pair_end;          // of the pairs that are looked at
  uint item, item_count;              // of the work-items, or groups, that do
  bool alone;  // there is one, and what it changes is no other's (lib/atomics.h)
  __global volatile uint* contact_count;
  // The meshes.
  __global const ox_mesh* meshes;
  __global const ox_chunk* chunks;
  __global const ox_vertex* vertices;
  __global const ox_edge* edges;
  __global const uint* ring_starts;
  __global const ox_neighbour* rings;
  ox_surfaces surfaces;
  // The pairs.
  __global const ox_object* objects;
  __global const uint* pair_objects;  // two of each
  __global ox_pair* pairs;
  __global ox_found* found;
  __global ox_range* pair_ranges;  // of contacts
  // Lists.
  __global ox_meshlet_task* meshlet_tasks;
  __global ox_meshlet_pair* meshlet_pairs;
  __global ox_edge_crossing* crossings;
  __global uint* flood_words;
  __global ox_chunk_task* tasks;
  __global ox_ray* rays;
  __global ox_hit* hits;
  __global ox_contact* contacts;
  // What becomes of crossings and hits.
  __global struct ox_feature* features;
  __global volatile uint* parents;
  __global volatile uint* slots;
  __global struct ox_region* regions;
  __global float* members;
  __global struct ox_face* faces;
  __global float* planes;
  __global uint* edge_planes;
  __global float* candidates;
} ox_scene;

// In the order of BatchData::launch (search/batch_data.h).
#define OX_SCENE_PARAMETERS                                                                        \
  __global volatile uint *counters, __global const ox_list *lists, uint modes, uint max_contacts,  \
      uint max_deformable, uint pair_count, __global const ox_mesh *meshes,                        \
      __global const ox_chunk *chunks, __global const ox_vertex *vertices,                         \
      __global const ox_edge *edges, __global const uint *ring_starts,                             \
      __global const ox_neighbour *rings, __global const ox_triangle *triangles,                   \
      __global const ox_meshlet *meshlets, __global const ox_meshlet_node *meshlet_nodes,          \
      __global const ox_object *objects, __global const uint *pair_objects,                        \
      __global ox_pair *pairs, __global ox_found *found, __global ox_range *pair_ranges,           \
      __global ox_meshlet_task *meshlet_tasks, __global ox_meshlet_pair *meshlet_pairs,            \
      __global ox_edge_crossing *crossings, __global uint *flood_words,                            \
      __global ox_chunk_task *tasks, __global ox_ray *rays, __global ox_hit *hits,                 \
      __global ox_contact *contacts, __global struct ox_feature *features, __global uint *parents, \
      __global uint *slots, __global struct ox_region *regions, __global float *members,           \
      __global struct ox_face *faces, __global float *planes, __global uint *edge_planes,          \
      __global float *candidates

#define OX_SCENE                                                                               \
  {                                                                                            \
    counters, lists, modes, max_contacts, max_deformable, 0u, pair_count, OX_FIRST_WORK,       \
        OX_WORK_STRIDE, false, counters + OX_LIST_CONTACTS *OX_COUNTER_STRIDE, meshes, chunks, \
        vertices, edges, ring_starts, rings, {triangles, meshlets, meshlet_nodes}, objects,    \
        pair_objects, pairs, found, pair_ranges, meshlet_tasks, meshlet_pairs, crossings,      \
        flood_words, tasks, rays, hits, contacts, features, parents, slots, regions, members,  \
        faces, planes, edge_planes, candidates                                                 \
  }

#endif
