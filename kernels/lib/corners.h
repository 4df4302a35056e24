// SPDX-License-Identifier: BSD-3-Clause
// The corners of the triangles of a meshlet, from its vertices: these are moved to where a step
// wants them, once, and each corner takes its own. Device only.
#ifndef ODE_EXT_KERNELS_LIB_CORNERS_H
#define ODE_EXT_KERNELS_LIB_CORNERS_H

#include "lib/lanes.h"

// As many points as a vector has lanes.
typedef struct {
  ox_floats x, y, z;
} ox_points;

// The vertices of a meshlet, moved.
typedef struct {
#if defined(OX_LANES_ARE_GROUP)
  float x, y, z;
#else
  float x[OX_LANES], y[OX_LANES], z[OX_LANES];
#endif
} ox_moved_vertices;

static inline void ox_set_vertices(ox_moved_vertices* vertices, uint block, const ox_points* p) {
#if defined(OX_LANES_ARE_GROUP)
  (void)block;  // the only one
  vertices->x = p->x;
  vertices->y = p->y;
  vertices->z = p->z;
#else
  ox_store(p->x, block, vertices->x);
  ox_store(p->y, block, vertices->y);
  ox_store(p->z, block, vertices->z);
#endif
}

#if !defined(OX_LANES_ARE_GROUP)
static inline void ox_vertices_of(const ox_moved_vertices* vertices, uint block, ox_points* p) {
  p->x = ox_load_own(block, vertices->x);
  p->y = ox_load_own(block, vertices->y);
  p->z = ox_load_own(block, vertices->z);
}
#endif

// Where a corner of a block of the triangles is among the vertices.
static inline void ox_places_of_corner(__global const ox_meshlet* meshlet, uint block, uint corner,
                                       ox_ints* lanes) {
  *lanes = ox_load_ints(block, meshlet->places) >> (int)OX_CORNER_SHIFT(corner) & 255;
}

// A corner of a block of the triangles. Those beyond the last have three equal ones.
static inline void ox_corners_of(__global const ox_meshlet* meshlet,
                                 const ox_moved_vertices* vertices, uint block, uint corner,
                                 ox_points* p) {
  ox_ints lanes;
  ox_places_of_corner(meshlet, block, corner, &lanes);
#if defined(OX_LANES_ARE_GROUP)
  p->x = as_float(ox_of_item(as_uint(vertices->x), (uint)lanes));
  p->y = as_float(ox_of_item(as_uint(vertices->y), (uint)lanes));
  p->z = as_float(ox_of_item(as_uint(vertices->z), (uint)lanes));
#else
  ox_pick_lanes(vertices->x, &lanes, &p->x);
  ox_pick_lanes(vertices->y, &lanes, &p->y);
  ox_pick_lanes(vertices->z, &lanes, &p->z);
#endif
}

// A bit for each triangle of a block that has an area; only those have a normal.
static inline uint ox_lanes_with_area(__global const ox_meshlet* meshlet, uint block) {
  return meshlet->with_area >> (OX_VECTOR_WIDTH * block) & OX_ALL_LANES;
}

#endif
