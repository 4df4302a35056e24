// SPDX-License-Identifier: BSD-3-Clause
// What lies within a facet, a flat piece of surface. Device only.
#ifndef ODE_EXT_KERNELS_LIB_FLAT_H
#define ODE_EXT_KERNELS_LIB_FLAT_H

#include "lib/scene.h"

// Whether the faces at an edge are of one facet.
static inline bool ox_is_flat_edge(const ox_scene* scene, uint edge) {
  const uint second = scene->edges[edge].triangle[1];
  return second != OX_NONE &&
         scene->facets[scene->edges[edge].triangle[0]] == scene->facets[second];
}

// Whether a vertex is within a facet, so that it bounds nothing. Of a mesh that changes its shape,
// or of one beside it, every vertex may need a contact.
static inline bool ox_is_flat_vertex(const ox_scene* scene, uint pair, uint vertex) {
  __global const uint* of_pair = scene->pairs[pair].mesh;
  if (((scene->meshes[of_pair[0]].flags | scene->meshes[of_pair[1]].flags) & OX_MESH_DEFORMABLE) !=
      0u)
    return false;
  for (uint k = scene->ring_starts[vertex]; k < scene->ring_starts[vertex + 1u]; ++k)
    if (!ox_is_flat_edge(scene, scene->rings[k].edge)) return false;
  return true;
}

#endif
