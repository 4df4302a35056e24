// SPDX-License-Identifier: BSD-3-Clause
// What of a mesh can bound an overlap. How deep one mesh is in another along any direction is told
// by the outermost points of what they have in common: at these the mesh is not flat, and no valley
// either. Device only.
#ifndef ODE_EXT_KERNELS_LIB_BOUNDING_H
#define ODE_EXT_KERNELS_LIB_BOUNDING_H

#include "lib/ring.h"

static inline __global const ox_mesh* ox_mesh_of(const ox_scene* scene,
                                                 __global const ox_pair* pair, uint side) {
  return scene->meshes + pair->mesh[side];
}

// Whether the faces at an edge are of one facet, a flat piece of surface.
static inline bool ox_is_flat_edge(__global const ox_mesh* mesh, uint edge) {
  return edge >= mesh->flat_edge_first;
}

// Of a mesh that changes its shape, or of one beside it, everything may need a contact.
static inline bool ox_is_rigid_pair(const ox_scene* scene, __global const ox_pair* pair) {
  return ((ox_mesh_of(scene, pair, 0u)->flags | ox_mesh_of(scene, pair, 1u)->flags) &
          OX_MESH_DEFORMABLE) == 0u;
}

// Whether a vertex of a mesh can: it is extreme (mesh/extreme_vertices.h).
static inline bool ox_vertex_bounds(const ox_scene* scene, __global const ox_pair* pair,
                                    uint vertex) {
  return (scene->ring_starts[vertex] & OX_RING_BOUNDS_NOTHING) == 0u ||
         !ox_is_rigid_pair(scene, pair);
}

#endif
