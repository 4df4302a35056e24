// SPDX-License-Identifier: BSD-3-Clause
// What cannot collide: the tests that chunks and vertices must pass before a ray is cast, the same
// in both organisations. Device only.
#ifndef ODE_EXT_KERNELS_SHARED_CULL_H
#define ODE_EXT_KERNELS_SHARED_CULL_H

#include "shared/near_surface.h"

// Whether the box of the chunk, in the frame of the target, reaches the target's.
static inline bool ox_chunk_meets_box(__global const ox_pair* pair, uint side,
                                      __global const ox_mesh* target,
                                      __global const ox_chunk* chunk, float3 middle, float reach) {
  const float3 d = fabs(middle - vload3(0, target->box_centre));
  const float3 limit = ox_turn_extents(pair, side, vload3(0, chunk->half_size)) +
                       vload3(0, target->box_half) + (pair->epsilon + reach);
  return d.x <= limit.x && d.y <= limit.y && d.z <= limit.z;
}

// Whether something of the chunk, as long as `reach` towards it, may come to the surface of the
// target; or, if `solid`, to what is not outside it.
static inline bool ox_chunk_may_near(__global const ox_pair* pair, uint side,
                                     __global const ox_mesh* target, __global const uint* grids,
                                     __global const ox_chunk* chunk, float3 middle, float reach,
                                     bool solid) {
  if ((target->flags & OX_MESH_CLEARANCE) == 0u) return true;
  const float more = pair->epsilon + reach;
  const float radius = chunk->radius + more;
  const ox_grid_place place = ox_place_in_grid(target, middle);
  if (ox_is_clear(target, grids, &place, radius, solid)) return false;
  const uint slab = ox_find_slab(target, grids, &place, radius);
  if (slab == OX_NONE) return true;
  const float3 normal = ox_slab_normal(grids + slab);
  const float3 in_source = fabs(ox_turn(pair, 1u - side, normal));
  const float along = ox_dot(in_source, vload3(0, chunk->half_size)) + more;
  return !ox_clears_slab(grids + slab, ox_dot(normal, place.within), along, !solid);
}

// Whether a vertex of the chunk can be in contact with the target.
static inline bool ox_keep_chunk(__global const ox_pair* pair, uint side,
                                 __global const ox_mesh* target, __global const ox_chunk* chunk,
                                 __global const uint* grids) {
  const float3 middle = ox_place(pair, side, vload3(0, chunk->centre));
  // Inside a closed target is inside its box; under an open one is not: the ray has to reach it.
  const bool closed = (target->flags & OX_MESH_CLOSED) != 0u;
  const float reach = closed ? 0.0f : chunk->reach;
  return ox_chunk_meets_box(pair, side, target, chunk, middle, reach) &&
         ox_chunk_may_near(pair, side, target, grids, chunk, middle, reach, closed);
}

// Inside a closed mesh is inside its box, not in a cell that is wholly outside, and not above a
// slab that outside is above of.
static inline bool ox_may_be_inside(__global const ox_mesh* mesh, __global const uint* grids,
                                    float3 p, float epsilon) {
  const float3 d = fabs(p - vload3(0, mesh->box_centre));
  const float3 limit = vload3(0, mesh->box_half) + epsilon;
  if (d.x > limit.x || d.y > limit.y || d.z > limit.z) return false;
  if ((mesh->flags & OX_MESH_GRID) == 0u) return true;
  const ox_grid_place place = ox_place_in_grid(mesh, p);
  // Cells know of points off the surface by less than their margin, 2e-5 of the box's half diagonal
  // (geometry/mesh.cpp). Where a pair rounds to more than half of that, distances do.
  const float3 half_size = vload3(0, mesh->box_half);
  if (epsilon * epsilon > 1e-10f * ox_dot(half_size, half_size))
    return !ox_is_clear(mesh, grids, &place, epsilon, true);
  // As may_be_inside on the host: compared before it is converted.
  const float point[3] = {p.x, p.y, p.z};
  uint bit = 0u;
  for (uint axis = 3u; axis-- > 0u;) {
    const float cell = (point[axis] - mesh->grid_origin[axis]) * mesh->grid_scale[axis];
    if (!(cell >= 0.0f && cell < (float)mesh->grid_cells[axis])) return false;
    bit = bit * mesh->grid_cells[axis] + (uint)cell;
  }
  if ((grids[mesh->grid_first + (bit >> 5)] >> (bit & 31u) & 1u) == 0u) return false;
  const uint slab = ox_find_slab(mesh, grids, &place, epsilon);
  return slab == OX_NONE ||
         !ox_clears_slab(grids + slab, ox_dot(ox_slab_normal(grids + slab), place.within), epsilon,
                         false);
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
  if (!ox_may_near_surface(target, grids, p, vertex->exit + epsilon)) return false;
  const float3 direction = ox_turn(pair, side, vload3(0, vertex->direction));
  const bool both_ways = (meshes[pair->mesh[side]].flags & OX_MESH_TWO_SIDED) != 0u;
  return ox_reaches_box(target, p, direction, vertex->exit + epsilon, both_ways, epsilon);
}

#endif
