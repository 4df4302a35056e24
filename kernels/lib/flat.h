// SPDX-License-Identifier: BSD-3-Clause
// What lies within a facet, a flat piece of surface. Device only.
#ifndef ODE_EXT_KERNELS_LIB_FLAT_H
#define ODE_EXT_KERNELS_LIB_FLAT_H

#include "lib/scene.h"

static inline __global const ox_mesh* ox_mesh_of(const ox_scene* scene,
                                                 __global const ox_pair* pair, uint side) {
  return scene->meshes + pair->mesh[side];
}

// Whether the faces at an edge are of one facet.
static inline bool ox_is_flat_edge(__global const ox_mesh* mesh, uint edge) {
  return edge >= mesh->flat_edge_first;
}

// Whether a vertex is within a facet, so that it bounds nothing: then the first edge at it is, too.
// Of a mesh that changes its shape, and of one in a sheet, every vertex may need a contact.
static inline bool ox_is_flat_vertex(const ox_scene* scene, __global const ox_pair* pair, uint side,
                                     uint vertex) {
  __global const ox_mesh* mesh = ox_mesh_of(scene, pair, side);
  if ((mesh->flags & OX_MESH_DEFORMABLE) != 0u ||
      (ox_mesh_of(scene, pair, 1u - side)->flags & OX_MESH_TWO_SIDED) != 0u)
    return false;
  const uint first = scene->ring_starts[vertex];
  return first == scene->ring_starts[vertex + 1u] ||
         ox_is_flat_edge(mesh, scene->rings[first].edge);
}

#endif
