// SPDX-License-Identifier: BSD-3-Clause
// The edges of one meshlet against the triangles of another, in general position: by floats where
// their rounding leaves no doubt, else exactly (lib/exact_sign.h). Device only.
#ifndef ODE_EXT_KERNELS_LIB_INTERSECT_H
#define ODE_EXT_KERNELS_LIB_INTERSECT_H

#include "lib/corners.h"
#include "lib/exact_sign.h"
#include "lib/meshlet.h"

// What a determinant of three differences, exact each, is off by at most, in parts of the product
// of the largest coordinates of the three. Each term of a minor takes 3 roundings of at most twice
// that product of two, each term of the determinant 2 more and their sum 2: 12, 12 and 6 times
// 2^-24; 32 of them.
#define OX_DETERMINANT_ROUNDING 0x1p-19f

// The vertices of a meshlet in general position, lane by lane, and beyond which sides of the other
// one's box and slab each lies, a bit for each side.
typedef struct {
  ox_moved_vertices at;
  int beyond[OX_LANES];
} ox_general_points;

// The triangles of one: corners a, b, c; x, y, z.
typedef struct {
  float corner[3][3][OX_LANES];
} ox_general_triangles;

static inline void ox_place_generally(__global const ox_pair* pair, uint side,
                                      __global const ox_meshlet* meshlet, ox_general_points* p) {
  __global const float* r = pair->rotation[0];
  __global const float* o = pair->base_offset[0];
  __global const float* base = pair->base[side];
  const float out = OX_INFLATION * pair->epsilon;
  const float snap = pair->snap;
  for (uint block = 0u; block < OX_BLOCKS; ++block) {
    ox_floats x = ox_load(block, meshlet->vertex[0]) - base[0];
    ox_floats y = ox_load(block, meshlet->vertex[1]) - base[1];
    ox_floats z = ox_load(block, meshlet->vertex[2]) - base[2];
    if (side == 0u) {
      const ox_floats nx = -ox_load(block, meshlet->normal[0]);
      const ox_floats ny = -ox_load(block, meshlet->normal[1]);
      const ox_floats nz = -ox_load(block, meshlet->normal[2]);
      const ox_floats px = r[0] * x + r[1] * y + r[2] * z + o[0];
      const ox_floats py = r[3] * x + r[4] * y + r[5] * z + o[1];
      const ox_floats pz = r[6] * x + r[7] * y + r[8] * z + o[2];
      x = px - out * (r[0] * nx + r[1] * ny + r[2] * nz);
      y = py - out * (r[3] * nx + r[4] * ny + r[5] * nz);
      z = pz - out * (r[6] * nx + r[7] * ny + r[8] * nz);
    }
    const ox_points on_grid = {x + snap - snap, y + snap - snap, z + snap - snap};
    ox_set_vertices(&p->at, block, &on_grid);
  }
}

static inline float3 ox_general_point(const ox_general_points* p, uint k) {
  return (float3)(p->at.x[k], p->at.y[k], p->at.z[k]);
}

static inline void ox_range_of(const float* values, float* least, float* greatest) {
  ox_floats lo = ox_load_own(0u, values);
  ox_floats hi = lo;
  for (uint block = 1u; block < OX_BLOCKS; ++block) {
    const ox_floats v = ox_load_own(block, values);
    lo = OX_LESSER(lo, v);
    hi = OX_GREATER(hi, v);
  }
  *least = ox_least_of(&lo);
  *greatest = ox_greatest_of(&hi);
}

static inline ox_box ox_box_of_points(const ox_general_points* p) {
  float lo[3], hi[3];
  ox_range_of(p->at.x, &lo[0], &hi[0]);
  ox_range_of(p->at.y, &lo[1], &hi[1]);
  ox_range_of(p->at.z, &lo[2], &hi[2]);
  ox_box box;
  box.lo = vload3(0, lo);
  box.hi = vload3(0, hi);
  return box;
}

// Notes beyond what each point lies. False: all lie beyond one side.
static inline bool ox_note_beyond(ox_general_points* p, const ox_box* box, const ox_slab* slab) {
  const float3 lo = box->lo;
  const float3 hi = box->hi;
  const float3 n = slab->normal;
  int beyond_all = -1;
  for (uint block = 0u; block < OX_BLOCKS; ++block) {
    ox_points at;
    ox_vertices_of(&p->at, block, &at);
    const ox_floats height = n.x * at.x + n.y * at.y + n.z * at.z;
    const ox_ints none = 0;
    const ox_ints beyond = (at.x < lo.x ? none + 1 : none) | (at.x > hi.x ? none + 2 : none) |
                           (at.y < lo.y ? none + 4 : none) | (at.y > hi.y ? none + 8 : none) |
                           (at.z < lo.z ? none + 16 : none) | (at.z > hi.z ? none + 32 : none) |
                           (height < slab->lo ? none + 64 : none) |
                           (height > slab->hi ? none + 128 : none);
    ox_store_ints(beyond, block, p->beyond);
    beyond_all &= ox_and_of(&beyond);
  }
  return beyond_all == 0;
}

static inline void ox_gather_triangles(__global const ox_meshlet* meshlet,
                                       const ox_general_points* p, ox_block_range blocks,
                                       ox_general_triangles* t) {
  for (uint block = blocks.first; block < blocks.end; ++block)
    for (uint corner = 0u; corner < 3u; ++corner) {
      ox_points corners;
      ox_corners_of(meshlet, &p->at, block, corner, &corners);
      ox_store(corners.x, block, t->corner[corner][0]);
      ox_store(corners.y, block, t->corner[corner][1]);
      ox_store(corners.z, block, t->corner[corner][2]);
    }
}

static inline float3 ox_general_corner(const ox_general_triangles* t, uint corner, uint k) {
  return (float3)(t->corner[corner][0][k], t->corner[corner][1][k], t->corner[corner][2][k]);
}

// A bit for each triangle of the blocks whose box that of an edge meets. What lies apart from one
// by coordinates on the grid, be it by one of its steps, does not meet the triangle, whatever
// decides of what touches (lib/exact_sign.h).
static inline uint ox_boxes_met(const ox_general_triangles* t, ox_block_range blocks, float3 p,
                                float3 q) {
  const float lo[3] = {ox_min(p.x, q.x), ox_min(p.y, q.y), ox_min(p.z, q.z)};
  const float hi[3] = {ox_max(p.x, q.x), ox_max(p.y, q.y), ox_max(p.z, q.z)};
  uint met = 0u;
  for (uint block = blocks.first; block < blocks.end; ++block) {
    ox_ints meets = -1;
    for (uint axis = 0u; axis < 3u; ++axis) {
      const ox_floats a = ox_load_own(block, t->corner[0][axis]);
      const ox_floats b = ox_load_own(block, t->corner[1][axis]);
      const ox_floats c = ox_load_own(block, t->corner[2][axis]);
      meets &= (OX_LESSER(OX_LESSER(a, b), c) <= hi[axis]) &
               (OX_GREATER(OX_GREATER(a, b), c) >= lo[axis]);
    }
    met |= ox_mask_of(&meets) << (OX_VECTOR_WIDTH * block);
  }
  return met;
}

// Of a point, a bit for each triangle of the blocks: whether it is above its plane, and whether
// that is in doubt.
typedef struct {
  uint above, doubt;
} ox_heights;

#define OX_LARGEST_OF(x, y, z) OX_GREATER(OX_GREATER(fabs(x), fabs(y)), fabs(z))

// Normals of the triangles, and what the heights of points over them are in doubt by, in parts of
// how far a coordinate of a point is from that of a.
typedef struct {
  float normal[3][OX_LANES];
  float doubt[OX_LANES];
} ox_general_planes;

static inline void ox_make_planes(const ox_general_triangles* t, ox_block_range blocks,
                                  ox_general_planes* planes) {
  for (uint block = blocks.first; block < blocks.end; ++block) {
    const ox_floats ax = ox_load_own(block, t->corner[0][0]);
    const ox_floats ay = ox_load_own(block, t->corner[0][1]);
    const ox_floats az = ox_load_own(block, t->corner[0][2]);
    const ox_floats ux = ox_load_own(block, t->corner[1][0]) - ax;
    const ox_floats uy = ox_load_own(block, t->corner[1][1]) - ay;
    const ox_floats uz = ox_load_own(block, t->corner[1][2]) - az;
    const ox_floats vx = ox_load_own(block, t->corner[2][0]) - ax;
    const ox_floats vy = ox_load_own(block, t->corner[2][1]) - ay;
    const ox_floats vz = ox_load_own(block, t->corner[2][2]) - az;
    ox_store(uy * vz - uz * vy, block, planes->normal[0]);
    ox_store(uz * vx - ux * vz, block, planes->normal[1]);
    ox_store(ux * vy - uy * vx, block, planes->normal[2]);
    ox_store(OX_DETERMINANT_ROUNDING * OX_LARGEST_OF(ux, uy, uz) * OX_LARGEST_OF(vx, vy, vz), block,
             planes->doubt);
  }
}

// No coordinate of a point in one box differs by more from that of one in the other [m].
static inline float ox_reach_of(const ox_box* a, const ox_box* b) {
  const float3 reach = OX_GREATER(a->hi - b->lo, b->hi - a->lo);
  return ox_max(ox_max(reach.x, reach.y), reach.z);
}

// `reach` [m]: no coordinate of the point differs by more from that of a corner. A bound of all of
// both meshlets takes the place of one for each point and triangle: the few more signs that are in
// doubt by it cost less than to find the largest of three coordinates lane by lane.
static inline ox_heights ox_heights_over(const ox_general_triangles* t,
                                         const ox_general_planes* planes, ox_block_range blocks,
                                         float reach, float3 p) {
  ox_heights heights = {0u, 0u};
  for (uint block = blocks.first; block < blocks.end; ++block) {
    const ox_floats x = p.x - ox_load_own(block, t->corner[0][0]);
    const ox_floats y = p.y - ox_load_own(block, t->corner[0][1]);
    const ox_floats z = p.z - ox_load_own(block, t->corner[0][2]);
    const ox_floats height = ox_load_own(block, planes->normal[0]) * x +
                             ox_load_own(block, planes->normal[1]) * y +
                             ox_load_own(block, planes->normal[2]) * z;
    const ox_ints above = height > 0.0f;
    const ox_ints doubtful = fabs(height) <= reach * ox_load_own(block, planes->doubt);
    heights.above |= ox_mask_of(&above) << (OX_VECTOR_WIDTH * block);
    heights.doubt |= ox_mask_of(&doubtful) << (OX_VECTOR_WIDTH * block);
  }
  return heights;
}

// How the line from p along d passes triangles of the blocks, a bit for each: with all edges on its
// left, or on its right, surely, or perhaps. `reach`: as in ox_heights_over.
typedef struct {
  uint left, right, perhaps_left, perhaps_right;
} ox_passes;

static inline ox_passes ox_passes_of(const ox_general_triangles* t, ox_block_range blocks,
                                     float reach, float3 p, float3 d) {
  ox_passes passes = {0u, 0u, 0u, 0u};
  const float doubt = OX_DETERMINANT_ROUNDING * OX_LARGEST_OF(d.x, d.y, d.z) * reach * reach;
  for (uint block = blocks.first; block < blocks.end; ++block) {
    const ox_floats ax = ox_load_own(block, t->corner[0][0]) - p.x;
    const ox_floats ay = ox_load_own(block, t->corner[0][1]) - p.y;
    const ox_floats az = ox_load_own(block, t->corner[0][2]) - p.z;
    const ox_floats bx = ox_load_own(block, t->corner[1][0]) - p.x;
    const ox_floats by = ox_load_own(block, t->corner[1][1]) - p.y;
    const ox_floats bz = ox_load_own(block, t->corner[1][2]) - p.z;
    const ox_floats cx = ox_load_own(block, t->corner[2][0]) - p.x;
    const ox_floats cy = ox_load_own(block, t->corner[2][1]) - p.y;
    const ox_floats cz = ox_load_own(block, t->corner[2][2]) - p.z;
    // d x a and d x b: d . (b x c) is c . (d x b), and so on.
    const ox_floats dax = d.y * az - d.z * ay;
    const ox_floats day = d.z * ax - d.x * az;
    const ox_floats daz = d.x * ay - d.y * ax;
    const ox_floats dbx = d.y * bz - d.z * by;
    const ox_floats dby = d.z * bx - d.x * bz;
    const ox_floats dbz = d.x * by - d.y * bx;
    const ox_floats u = cx * dbx + cy * dby + cz * dbz;
    const ox_floats v = -(cx * dax + cy * day + cz * daz);
    const ox_floats w = bx * dax + by * day + bz * daz;
    const ox_floats least = OX_LESSER(OX_LESSER(u, v), w);
    const ox_floats greatest = OX_GREATER(OX_GREATER(u, v), w);
    const ox_ints left = least > doubt;
    const ox_ints right = greatest < -doubt;
    const ox_ints perhaps_left = least >= -doubt;
    const ox_ints perhaps_right = greatest <= doubt;
    const uint shift = OX_VECTOR_WIDTH * block;
    passes.left |= ox_mask_of(&left) << shift;
    passes.right |= ox_mask_of(&right) << shift;
    passes.perhaps_left |= ox_mask_of(&perhaps_left) << shift;
    passes.perhaps_right |= ox_mask_of(&perhaps_right) << shift;
  }
  return passes;
}

#endif
