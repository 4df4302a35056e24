// SPDX-License-Identifier: BSD-3-Clause
// Of which sides of a pair crossings tell which vertices are inside (flood.cl). Device
// only.
#ifndef ODE_EXT_KERNELS_LIB_FLOODED_H
#define ODE_EXT_KERNELS_LIB_FLOODED_H

#include "lib/scene.h"

// All but those of sheets, of which something counts as beyond that no edge crosses: a sheet as
// target has no inside, and as source it reaches as far as its thickness beside an open target.
static inline bool ox_is_flooded(const ox_scene* scene, __global const ox_mesh* source,
                                 __global const ox_mesh* target) {
  if ((scene->modes & OX_MODE_FLOOD) == 0u || (target->flags & OX_MESH_TWO_SIDED) != 0u)
    return false;
  return (source->flags & OX_MESH_TWO_SIDED) == 0u || (target->flags & OX_MESH_CLOSED) != 0u;
}

#endif
