// SPDX-License-Identifier: BSD-3-Clause
// How near to the surface of a mesh something may come: by the clearance grid, and where it knows
// too little by the slab at the block. Device only.
#ifndef ODE_EXT_KERNELS_SHARED_NEAR_SURFACE_H
#define ODE_EXT_KERNELS_SHARED_NEAR_SURFACE_H

#include "shared/transform.h"

// Where a point is in the grids of a mesh.
typedef struct {
  uint block;     // the nearest one
  float3 within;  // [m] of the nearest point of the grid, from the middle of the block
  float within2;  // the same, squared, in steps of the clearance
  float beyond2;  // how far it is from there to the point, likewise; 0: the point is in the grid
} ox_grid_place;

static inline ox_grid_place ox_place_in_grid(__global const ox_mesh* mesh, float3 p) {
  const uint3 cells = vload3(0, mesh->grid_cells);
  const float3 side = vload3(0, mesh->grid_side);
  const float3 cell = (p - vload3(0, mesh->grid_origin)) * vload3(0, mesh->grid_scale);
  const float3 nearest = fmin(fmax(cell, 0.0f), convert_float3(cells));
  const uint3 blocks = (cells + (OX_BLOCK_CELLS - 1u)) / OX_BLOCK_CELLS;
  const uint3 block = min(convert_uint3(nearest) / OX_BLOCK_CELLS, blocks - 1u);
  const float3 middle = convert_float3(block * OX_BLOCK_CELLS + OX_BLOCK_CELLS / 2u);
  // Bounded, so that its square is finite; what is nearer than it is still is.
  const float3 beyond = fmin(fabs(cell - nearest) * side * mesh->steps_per_metre, 1e18f);
  ox_grid_place place;
  place.block = (block.z * blocks.y + block.y) * blocks.x + block.x;
  place.within = (nearest - middle) * side;
  const float3 steps = place.within * mesh->steps_per_metre;
  place.within2 = ox_dot(steps, steps);
  place.beyond2 = ox_dot(beyond, beyond);
  return place;
}

// Whether no point within `radius` [m] of the place is on the surface of the mesh or, if `solid`,
// inside. As clearance() on the host (geometry/clearance_grid.h).
static inline bool ox_is_clear(__global const ox_mesh* mesh, __global const uint* grids,
                               const ox_grid_place* place, float radius, bool solid) {
  const uint word = grids[mesh->clearance_first + (place->block >> 2)];
  const float steps = (float)(char)(word >> 8u * (place->block & 3u) & 255u);
  const float reach = radius * mesh->steps_per_metre;
  if (place->beyond2 == 0.0f) {
    const float left = (solid ? steps : fabs(steps)) - reach;
    return left > 0.0f && left * left > place->within2;
  }
  const float known = ox_max(fabs(steps) - sqrt(place->within2), 0.0f);
  return place->beyond2 + known * known > reach * reach;
}

// The word of the slab at a place, for what is within `radius` of it; OX_NONE: none is known.
static inline uint ox_find_slab(__global const ox_mesh* mesh, __global const uint* grids,
                                const ox_grid_place* place, float radius) {
  if (!(radius <= mesh->slab_reach) || place->beyond2 != 0.0f) return OX_NONE;
  const uint word = mesh->slab_bits_first + 2u * (place->block >> 5);
  const uint bit = 1u << (place->block & 31u);
  const uint bits = grids[word];
  if ((bits & bit) == 0u) return OX_NONE;
  const uint rank = grids[word + 1u] + popcount(bits & (bit - 1u));
  return mesh->slab_first + OX_SLAB_WORDS * rank;
}

static inline float3 ox_slab_normal(__global const uint* slab) {
  return (float3)(as_float(slab[0]), as_float(slab[1]), as_float(slab[2]));
}

// Whether what reaches so far along the normal, from `height`, is apart from the slab; `below` too,
// or only where that is outside.
static inline bool ox_clears_slab(__global const uint* slab, float height, float reach,
                                  bool below) {
  const bool above = height - reach > as_float(slab[4]);
  return below ? above || height + reach < as_float(slab[3]) : above && slab[5] != 0u;
}

// Whether the surface of the mesh may come within `radius` of a point.
static inline bool ox_may_near_surface(__global const ox_mesh* mesh, __global const uint* grids,
                                       float3 p, float radius) {
  if ((mesh->flags & OX_MESH_CLEARANCE) == 0u) return true;
  const ox_grid_place place = ox_place_in_grid(mesh, p);
  if (ox_is_clear(mesh, grids, &place, radius, false)) return false;
  const uint slab = ox_find_slab(mesh, grids, &place, radius);
  return slab == OX_NONE ||
         !ox_clears_slab(grids + slab, ox_dot(ox_slab_normal(grids + slab), place.within), radius,
                         true);
}

#endif
