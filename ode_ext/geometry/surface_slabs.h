// SPDX-License-Identifier: BSD-3-Clause
// Two planes between which the surface of a mesh lies near a block of the clearance grid. Where the
// surface is nearly flat they tell much better than a distance how near one may come to it: what
// lies on a floor of large triangles is dismissed although it is only just above it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/bvh.h"
#include "geometry/clearance_grid.h"
#include "geometry/occupancy_grid.h"
#include "geometry/vec.h"

namespace ode_ext {

// The surface, as far as it is within SurfaceSlabs::reach of the block, lies where
// lo <= dot(normal, p - centre of the block) <= hi.
struct SurfaceSlab {
  Vec3f normal;           // unit
  float lo, hi;           // [m]
  std::uint32_t outside;  // 1: what lies above hi, within the same reach, is outside the mesh
};

struct SurfaceSlabs {
  float reach = 0;                   // [m]; 0: there are none
  std::vector<std::uint32_t> bits;   // of the blocks: 1 where one is known
  std::vector<std::uint32_t> ranks;  // per word of bits: how many come before it
  std::vector<SurfaceSlab> slabs;
};

// `margin` [m]: as of the occupancy grid; by so much the slabs are thicker on both sides.
SurfaceSlabs build_surface_slabs(const std::vector<Vec3f>& vertices,
                                 const std::vector<Triangle>& triangles, const Bvh& bvh,
                                 const OccupancyGrid& grid, const ClearanceGrid& clearance,
                                 float margin);

// The slab at a block; null if none is known.
const SurfaceSlab* find_slab(const SurfaceSlabs& slabs, std::size_t block);

}  // namespace ode_ext
