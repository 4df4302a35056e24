// SPDX-License-Identifier: BSD-3-Clause
// The test of ray_triangle.h for many triangles of a meshlet at a time. Device only.
#ifndef ODE_EXT_KERNELS_LIB_RAY_MESHLET_H
#define ODE_EXT_KERNELS_LIB_RAY_MESHLET_H

#include "lib/lanes.h"
#include "lib/ray_triangle.h"

// a * b - c * d with the right sign, as ox_det2.
static inline void ox_det2_lanes(const ox_floats* a, const ox_floats* b, const ox_floats* c,
                                 const ox_floats* d, ox_floats* result) {
  const ox_floats p = *a * *b;
  const ox_floats q = *c * *d;
  *result = p != q ? p - q : fma(*a, *b, -p) - fma(*c, *d, -q);
}

// ox_meets for a block of triangles, bit for bit: in which lanes the line of the cast meets one; *t
// is where [m], *determinant is negative where it leaves by it.
static inline void ox_meets_lanes(const ox_cast* cast, __global const ox_meshlet* m, uint block,
                                  ox_ints* met, ox_floats* t, ox_floats* determinant) {
  const uint kx = cast->kx;
  const uint ky = cast->ky;
  const uint kz = cast->kz;
  const float ox = ox_axis(cast->origin, kx);
  const float oy = ox_axis(cast->origin, ky);
  const float oz = ox_axis(cast->origin, kz);
  const ox_floats az = ox_load(block, m->corner[0][kz]) - oz;
  const ox_floats bz = ox_load(block, m->corner[1][kz]) - oz;
  const ox_floats cz = ox_load(block, m->corner[2][kz]) - oz;
  const ox_floats sx = -cast->sx;
  const ox_floats sy = -cast->sy;
  const ox_floats ax = fma(sx, az, ox_load(block, m->corner[0][kx]) - ox);
  const ox_floats ay = fma(sy, az, ox_load(block, m->corner[0][ky]) - oy);
  const ox_floats bx = fma(sx, bz, ox_load(block, m->corner[1][kx]) - ox);
  const ox_floats by = fma(sy, bz, ox_load(block, m->corner[1][ky]) - oy);
  const ox_floats cx = fma(sx, cz, ox_load(block, m->corner[2][kx]) - ox);
  const ox_floats cy = fma(sy, cz, ox_load(block, m->corner[2][ky]) - oy);
  ox_floats u, v, w;
  ox_det2_lanes(&cx, &by, &cy, &bx, &u);
  ox_det2_lanes(&ax, &cy, &ay, &cx, &v);
  ox_det2_lanes(&bx, &ay, &by, &ax, &w);
  const ox_ints mixed =
      ((u < 0.0f) | (v < 0.0f) | (w < 0.0f)) & ((u > 0.0f) | (v > 0.0f) | (w > 0.0f));
  *determinant = u + v + w;
  *met = (mixed == 0) & (*determinant != 0.0f);
  *t = (u * az + v * bz + w * cz) * cast->sz / *determinant;
}

#endif
