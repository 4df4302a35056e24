// SPDX-License-Identifier: BSD-3-Clause
// Meshlets in the frame of the other mesh of their pair. Device only.
#ifndef ODE_EXT_KERNELS_LIB_MESHLET_H
#define ODE_EXT_KERNELS_LIB_MESHLET_H

#include "lib/append.h"
#include "lib/corners.h"
#include "lib/meshlet_tree.h"

// A block of the vertices of a meshlet of the source in the frame of the target; lane by lane the
// bits of ox_transform.
static inline void ox_place_vertices(__global const ox_pair* pair, uint side,
                                     __global const ox_meshlet* meshlet, uint block,
                                     ox_points* points) {
  __global const float* r = pair->rotation[side];
  __global const float* o = pair->offset[side];
  const ox_floats x = ox_load(block, meshlet->vertex[0]);
  const ox_floats y = ox_load(block, meshlet->vertex[1]);
  const ox_floats z = ox_load(block, meshlet->vertex[2]);
  points->x = r[0] * x + r[1] * y + r[2] * z + o[0];
  points->y = r[3] * x + r[4] * y + r[5] * z + o[1];
  points->z = r[6] * x + r[7] * y + r[8] * z + o[2];
}

// The box of a meshlet of the source in the frame of the target.
static inline ox_box ox_box_there(__global const ox_pair* pair, uint side,
                                  __global const ox_meshlet* meshlet, float margin) {
  ox_points lo, hi;
  ox_place_vertices(pair, side, meshlet, 0u, &lo);
  hi = lo;
  for (uint block = 1u; block < OX_BLOCKS; ++block) {
    ox_points p;
    ox_place_vertices(pair, side, meshlet, block, &p);
    lo.x = OX_LESSER(lo.x, p.x);
    lo.y = OX_LESSER(lo.y, p.y);
    lo.z = OX_LESSER(lo.z, p.z);
    hi.x = OX_GREATER(hi.x, p.x);
    hi.y = OX_GREATER(hi.y, p.y);
    hi.z = OX_GREATER(hi.z, p.z);
  }
  ox_box box;
  box.lo = (float3)(ox_least_of(&lo.x), ox_least_of(&lo.y), ox_least_of(&lo.z)) - margin;
  box.hi = (float3)(ox_greatest_of(&hi.x), ox_greatest_of(&hi.y), ox_greatest_of(&hi.z)) + margin;
  return box;
}

// [m] what rounding can do to a height along a normal, from the origin on: turned and measured
// along, a coordinate takes less than 32 roundings. The margin is four times 16 (pair_step.cl).
#define OX_SLAB_ROUNDING(pair) (0.5f * (pair)->margin)

// The slab of a meshlet of the source in the frame of the target.
static inline ox_slab ox_slab_there(__global const ox_pair* pair, uint side,
                                    __global const ox_meshlet* meshlet, float margin) {
  ox_slab slab;
  slab.normal = ox_rotate(pair, side, vload3(0, meshlet->slab_normal));
  const float moved = ox_dot(slab.normal, vload3(0, pair->offset[side]));
  slab.lo = meshlet->slab_lo + moved - margin - OX_SLAB_ROUNDING(pair);
  slab.hi = meshlet->slab_hi + moved + margin + OX_SLAB_ROUNDING(pair);
  return slab;
}

// The slab of a meshlet in its own frame. Of A, whose vertices go out by OX_INFLATION times epsilon
// and onto a grid, only against what the margin is added to: that is twice as much and more.
static inline ox_slab ox_slab_of(__global const ox_pair* pair, __global const ox_meshlet* meshlet) {
  const ox_slab slab = {vload3(0, meshlet->slab_normal), meshlet->slab_lo - OX_SLAB_ROUNDING(pair),
                        meshlet->slab_hi + OX_SLAB_ROUNDING(pair)};
  return slab;
}

#endif
