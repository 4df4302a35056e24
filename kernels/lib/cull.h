// SPDX-License-Identifier: BSD-3-Clause
// What cannot collide: the tests that chunks and vertices must pass before a ray is cast, the same
// in both organizations. Device only.
#ifndef ODE_EXT_KERNELS_LIB_CULL_H
#define ODE_EXT_KERNELS_LIB_CULL_H

#include "lib/transform.h"

// [m] what is not known of where the vertices of a pair are.
#define OX_CULL_MARGIN(pair) ((pair)->margin)

// Whether a vertex of the chunk can be in contact with the target.
static inline bool ox_keep_chunk(__global const ox_pair* pair, uint side,
                                 __global const ox_mesh* target, __global const ox_chunk* chunk) {
  // Inside a closed target is inside its box; under an open one is not: the ray has to reach it.
  const float reach = (target->flags & OX_MESH_CLOSED) != 0u ? 0.0f : chunk->reach;
  const float3 middle = ox_transform(pair, side, vload3(0, chunk->centre));
  const float3 d = fabs(middle - vload3(0, target->box_centre));
  const float3 limit = ox_rotate_extents(pair, side, vload3(0, chunk->half_size)) +
                       vload3(0, target->box_half) + (OX_CULL_MARGIN(pair) + reach);
  return d.x <= limit.x && d.y <= limit.y && d.z <= limit.z;
}

// What a ray of length `length` can meet of an open mesh lies where it crosses the box; `back`: it
// runs as far the other way.
static inline bool ox_reaches_box(__global const ox_mesh* mesh, float3 p, float3 direction,
                                  float length, bool back, float epsilon) {
  const float3 d = p - vload3(0, mesh->box_centre);
  const float3 half_size = vload3(0, mesh->box_half) + epsilon;
  const float start[3] = {d.x, d.y, d.z};
  const float along[3] = {direction.x, direction.y, direction.z};
  const float limit[3] = {half_size.x, half_size.y, half_size.z};
  float t0 = back ? -length : 0.0f;
  float t1 = length;
  for (uint k = 0u; k < 3u; ++k) {
    if (along[k] == 0.0f) {
      if (fabs(start[k]) > limit[k]) return false;
      continue;
    }
    const float u = (-limit[k] - start[k]) / along[k];
    const float v = (limit[k] - start[k]) / along[k];
    t0 = ox_max(t0, ox_min(u, v));
    t1 = ox_min(t1, ox_max(u, v));
  }
  return t0 <= t1;
}

// Whether the vertex can be in contact with the target.
static inline bool ox_keep_vertex(__global const ox_pair* pair, uint side,
                                  __global const ox_mesh* meshes,
                                  __global const ox_vertex* vertex) {
  __global const ox_mesh* target = meshes + pair->mesh[1u - side];
  const float3 p = ox_transform(pair, side, vload3(0, vertex->position));
  if ((target->flags & OX_MESH_CLOSED) != 0u) {
    const float3 d = fabs(p - vload3(0, target->box_centre));
    const float3 limit = vload3(0, target->box_half) + OX_CULL_MARGIN(pair);
    return d.x <= limit.x && d.y <= limit.y && d.z <= limit.z;
  }
  if (vertex->exit == INFINITY) return false;  // its ray would never end
  const float3 direction = ox_rotate(pair, side, vload3(0, vertex->direction));
  const bool both_ways = (meshes[pair->mesh[side]].flags & OX_MESH_TWO_SIDED) != 0u;
  return ox_reaches_box(target, p, direction, vertex->exit + OX_CULL_MARGIN(pair), both_ways,
                        OX_CULL_MARGIN(pair));
}

#endif
