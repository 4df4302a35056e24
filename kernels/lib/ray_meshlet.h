// SPDX-License-Identifier: BSD-3-Clause
// The test of ray_triangle.h for many triangles of a meshlet at a time. Device only.
#ifndef ODE_EXT_KERNELS_LIB_RAY_MESHLET_H
#define ODE_EXT_KERNELS_LIB_RAY_MESHLET_H

#include "lib/corners.h"
#include "lib/ray_triangle.h"

// a * b - c * d with the right sign, as ox_det2.
static inline void ox_det2_lanes(const ox_floats* a, const ox_floats* b, const ox_floats* c,
                                 const ox_floats* d, ox_floats* result) {
  const ox_floats p = *a * *b;
  const ox_floats q = *c * *d;
  *result = p != q ? p - q : fma(*a, *b, -p) - fma(*c, *d, -q);
}

// The vertices of a meshlet as a cast sees them: from its origin, sheared so that it goes along z.
static inline void ox_shear_vertices(const ox_cast* cast, __global const ox_meshlet* m,
                                     ox_moved_vertices* seen) {
  for (uint block = 0u; block < OX_BLOCKS; ++block) {
    const float bx = ox_axis(cast->base, cast->kx), ox = ox_axis(cast->origin, cast->kx);
    const float by = ox_axis(cast->base, cast->ky), oy = ox_axis(cast->origin, cast->ky);
    const float bz = ox_axis(cast->base, cast->kz), oz = ox_axis(cast->origin, cast->kz);
    const ox_floats sx = -cast->sx;
    const ox_floats sy = -cast->sy;
    ox_points p;
    p.z = ox_load(block, m->vertex[cast->kz]) - bz - oz;
    p.x = fma(sx, p.z, ox_load(block, m->vertex[cast->kx]) - bx - ox);
    p.y = fma(sy, p.z, ox_load(block, m->vertex[cast->ky]) - by - oy);
    ox_set_vertices(seen, block, &p);
  }
}

// ox_meets for a block of triangles, bit for bit: a bit for each that the line of the cast meets;
// *t is where [m], *determinant is negative where it leaves by it.
static inline uint ox_meets_lanes(const ox_cast* cast, __global const ox_meshlet* m,
                                  const ox_moved_vertices* seen, uint block, float from, float to,
                                  ox_floats* t, ox_floats* determinant) {
  ox_points a, b, c;
  ox_corners_of(m, seen, block, 0u, &a);
  ox_corners_of(m, seen, block, 1u, &b);
  ox_corners_of(m, seen, block, 2u, &c);
  ox_floats u, v, w;
  ox_det2_lanes(&c.x, &b.y, &c.y, &b.x, &u);
  ox_det2_lanes(&a.x, &c.y, &a.y, &c.x, &v);
  ox_det2_lanes(&b.x, &a.y, &b.y, &a.x, &w);
  const ox_ints mixed =
      ((u < 0.0f) | (v < 0.0f) | (w < 0.0f)) & ((u > 0.0f) | (v > 0.0f) | (w > 0.0f));
  *determinant = u + v + w;
  *t = (u * a.z + v * b.z + w * c.z) * cast->sz / *determinant;
  const ox_ints met =
      (mixed == 0) & (*determinant != 0.0f) & (*t >= from) & (*t <= to) & (*t < INFINITY);
  return ox_mask_of(&met) & ox_lanes_with_area(m, block);
}

#endif
