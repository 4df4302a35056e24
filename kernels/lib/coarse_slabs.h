// SPDX-License-Identifier: BSD-3-Clause
// The slabs of a coarse mesh along the normals of its facets. Device only.
//
// A mesh of few triangles has meshlets as large as itself, whose boxes are mostly empty: of a crate
// that stands on a corner, in its own frame, all of a floor below is in its box. What is apart from
// it along a normal of its own is not near it (separating axis, Gottschalk 1996).
#ifndef ODE_EXT_KERNELS_LIB_COARSE_SLABS_H
#define ODE_EXT_KERNELS_LIB_COARSE_SLABS_H

#include "lib/corners.h"
#include "lib/meshlet.h"
#include "lib/scene.h"

#define OX_COARSE_FACETS 32u  // at most of a mesh that is coarse

typedef struct {
  uint count;
  ox_slab slab[OX_COARSE_FACETS];
} ox_coarse_slabs;

// How far the vertices of a mesh reach along a direction, in its frame.
static inline ox_slab ox_slab_of_mesh(const ox_scene* scene, __global const ox_mesh* mesh,
                                      float3 direction) {
  ox_floats lo = (ox_floats)(INFINITY), hi = (ox_floats)(-INFINITY);
  for (uint m = 0u; m < mesh->meshlet_count; ++m) {
    __global const ox_meshlet* meshlet = scene->surfaces.meshlets + mesh->meshlet_first + m;
    for (uint block = 0u; block < OX_BLOCKS; ++block) {
      const ox_floats along = direction.x * ox_load(block, meshlet->vertex[0]) +
                              direction.y * ox_load(block, meshlet->vertex[1]) +
                              direction.z * ox_load(block, meshlet->vertex[2]);
      lo = OX_LESSER(lo, along);
      hi = OX_GREATER(hi, along);
    }
  }
  const ox_slab slab = {direction, ox_least_of(&lo), ox_greatest_of(&hi)};
  return slab;
}

// Those of the target of a side of a pair, in the frame of the source; none where it is not coarse,
// or the source has no more than a node of meshlets to be asked for.
static inline void ox_find_coarse_slabs(const ox_scene* scene, __global const ox_pair* pair,
                                        uint side, ox_coarse_slabs* slabs) {
  __global const ox_mesh* source = scene->meshes + pair->mesh[side];
  __global const ox_mesh* target = scene->meshes + pair->mesh[1u - side];
  slabs->count = 0u;
  if (source->meshlet_node_count <= 1u || target->triangle_count > 2u * OX_COARSE_FACETS) return;
  const float3 offset = vload3(0, pair->offset[1u - side]);
  uint count = 0u;
  for (uint k = 0u; k < target->triangle_count; ++k) {
    __global const ox_triangle* t = scene->surfaces.triangles + target->triangle_first + k;
    if (t->facet != k) continue;
    if (count == OX_COARSE_FACETS) return;
    const ox_slab slab = ox_slab_of_mesh(scene, target, vload3(0, t->normal));
    const float3 normal = ox_rotate(pair, 1u - side, slab.normal);
    const float moved = ox_dot(normal, offset);
    const float unknown = pair->margin + OX_SLAB_ROUNDING(pair);
    slabs->slab[count].normal = normal;
    slabs->slab[count].lo = slab.lo + moved - unknown;
    slabs->slab[count++].hi = slab.hi + moved + unknown;
  }
  slabs->count = count;
}

// Of some children of a block those that meet all slabs, a bit for each.
static inline uint ox_children_in_slabs(const ox_coarse_slabs* slabs,
                                        __global const ox_meshlet_node* node, uint block,
                                        uint children) {
  for (uint i = 0u; i < slabs->count && children != 0u; ++i)
    children &= ox_children_in_slab(slabs->slab + i, node, block);
  return children;
}

#endif
