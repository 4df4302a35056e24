// SPDX-License-Identifier: BSD-3-Clause
// What cannot collide: the tests that chunks and vertices must pass before a ray is cast, the same
// in both organisations. Device only.
#ifndef ODE_EXT_KERNELS_SHARED_CULL_H
#define ODE_EXT_KERNELS_SHARED_CULL_H

#include "shared/transform.h"

// No point within this distance [m] of p may be inside the mesh (geometry/clearance_grid.h).
static inline float ox_clearance(__global const ox_mesh* mesh, __global const uint* grids,
                                 float3 p) {
  const float point[3] = {p.x, p.y, p.z};
  float moved = 0.0f;
  uint index = 0u;
  for (uint axis = 3u; axis-- > 0u;) {
    const uint cells = mesh->grid_cells[axis];
    const float scale = mesh->grid_scale[axis];
    const float cell = (point[axis] - mesh->grid_origin[axis]) * scale;
    const float nearest = ox_min(ox_max(cell, 0.0f), (float)cells - 1.0f);
    moved += fabs(cell - nearest) / scale;
    const uint blocks = (cells + (OX_BLOCK_CELLS - 1u)) / OX_BLOCK_CELLS;
    index = index * blocks + (uint)nearest / OX_BLOCK_CELLS;
  }
  const uint steps = grids[mesh->clearance_first + (index >> 2)] >> 8u * (index & 3u) & 255u;
  return ((float)steps - 1.0f) * mesh->block_side - moved;
}

// Whether a vertex of the chunk can be in contact with the target.
static inline bool ox_keep_chunk(__global const ox_pair* pair, uint side,
                                 __global const ox_mesh* target, __global const ox_chunk* chunk,
                                 __global const uint* grids) {
  const float epsilon = pair->epsilon;
  const float3 middle = ox_place(pair, side, vload3(0, chunk->centre));
  const float3 d = fabs(middle - vload3(0, target->box_centre));
  float3 limit = ox_turn_extents(pair, side, vload3(0, chunk->half_size)) +
                 vload3(0, target->box_half) + epsilon;
  // Inside a closed target is inside its box; under an open one is not: the ray has to reach it.
  if ((target->flags & OX_MESH_CLOSED) == 0u) limit += chunk->reach;
  if (d.x > limit.x || d.y > limit.y || d.z > limit.z) return false;
  return (target->flags & OX_MESH_GRID) == 0u ||
         ox_clearance(target, grids, middle) <= chunk->radius + epsilon;
}

// Inside a closed mesh is inside its box and not in a cell that is wholly outside.
static inline bool ox_may_be_inside(__global const ox_mesh* mesh, __global const uint* grids,
                                    float3 p, float epsilon) {
  const float3 d = fabs(p - vload3(0, mesh->box_centre));
  const float3 limit = vload3(0, mesh->box_half) + epsilon;
  if (d.x > limit.x || d.y > limit.y || d.z > limit.z) return false;
  if ((mesh->flags & OX_MESH_GRID) == 0u) return true;
  // As may_be_inside on the host: compared before it is converted.
  const float point[3] = {p.x, p.y, p.z};
  uint bit = 0u;
  for (uint axis = 3u; axis-- > 0u;) {
    const float cell = (point[axis] - mesh->grid_origin[axis]) * mesh->grid_scale[axis];
    if (!(cell >= 0.0f && cell < (float)mesh->grid_cells[axis])) return false;
    bit = bit * mesh->grid_cells[axis] + (uint)cell;
  }
  return (grids[mesh->grid_first + (bit >> 5)] >> (bit & 31u) & 1u) != 0u;
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
                                  __global const ox_mesh* meshes, __global const ox_vertex* vertex,
                                  __global const uint* grids) {
  __global const ox_mesh* target = meshes + pair->mesh[1u - side];
  const float epsilon = pair->epsilon;
  const float3 p = ox_place(pair, side, vload3(0, vertex->position));
  if ((target->flags & OX_MESH_CLOSED) != 0u) return ox_may_be_inside(target, grids, p, epsilon);
  if (vertex->exit == INFINITY) return false;  // its ray would never end
  const float3 direction = ox_turn(pair, side, vload3(0, vertex->direction));
  const bool both_ways = (meshes[pair->mesh[side]].flags & OX_MESH_TWO_SIDED) != 0u;
  return ox_reaches_box(target, p, direction, vertex->exit + epsilon, both_ways, epsilon);
}

#endif
