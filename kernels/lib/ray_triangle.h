// SPDX-License-Identifier: BSD-3-Clause
// Watertight ray/triangle test after Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection",
// JCGT 2(1), 2013, with exact edge signs in place of their fallback to double precision. Device
// only.
//
// The triangle is moved so that the ray starts at the origin and sheared so that it runs along +z;
// then the ray passes on one side of an edge or the other by the sign of a 2x2 determinant. Both
// triangles at an edge compute it from the same two sheared corners, so they cannot both miss.
#ifndef ODE_EXT_KERNELS_LIB_RAY_TRIANGLE_H
#define ODE_EXT_KERNELS_LIB_RAY_TRIANGLE_H

#include "lib/transform.h"

typedef struct {
  float3 base;     // in the frame of the mesh: where coordinates are taken from
  float3 origin;   // from there
  float3 start;    // and from the origin of the mesh, as boxes are
  float3 inverse;  // of the direction, for the boxes; never infinite
  uint kx, ky, kz;
  float sx, sy, sz;
} ox_cast;

static inline float ox_axis(float3 v, uint k) { return k == 0u ? v.x : (k == 1u ? v.y : v.z); }

// A direction this flat counts as not moving along that axis at all: over 1e6 times the size of a
// mesh it still moves less than the rounding of a coordinate.
static inline float ox_reciprocal(float d) {
  const float flat = 1.0e-14f;
  if (fabs(d) < flat) return d < 0.0f ? -1.0f / flat : 1.0f / flat;
  return 1.0f / d;
}

static inline ox_cast ox_cast_from(float3 base, float3 origin, float3 direction) {
  ox_cast cast;
  const float3 size = fabs(direction);
  uint kz = size.x > size.y ? 0u : 1u;
  if (size.z > ox_axis(size, kz)) kz = 2u;
  uint kx = kz == 2u ? 0u : kz + 1u;
  uint ky = kx == 2u ? 0u : kx + 1u;
  const float dz = ox_axis(direction, kz);
  if (dz < 0.0f) {  // keeps the winding
    const uint swap = kx;
    kx = ky;
    ky = swap;
  }
  cast.base = base;
  cast.origin = origin;
  cast.start = origin + base;
  cast.inverse =
      (float3)(ox_reciprocal(direction.x), ox_reciprocal(direction.y), ox_reciprocal(direction.z));
  cast.kx = kx;
  cast.ky = ky;
  cast.kz = kz;
  cast.sx = ox_axis(direction, kx) / dz;
  cast.sy = ox_axis(direction, ky) / dz;
  cast.sz = 1.0f / dz;
  return cast;
}

// a * b - c * d with the right sign, always: where the rounded products are equal their rounding
// errors, which fma gives exactly, decide.
static inline float ox_det2(float a, float b, float c, float d) {
  const float p = a * b;
  const float q = c * d;
  if (p != q) return p - q;
  return fma(a, b, -p) - fma(c, d, -q);
}

// Whether the line of the ray meets the triangle, its corners as its mesh has them; then *t is the
// distance (may be negative, always finite) and *back whether the ray leaves through it (direction
// . normal > 0).
static inline bool ox_meets(const ox_cast* cast, float3 a, float3 b, float3 c, float* t,
                            bool* back) {
  const float3 oa = a - cast->base - cast->origin;
  const float3 ob = b - cast->base - cast->origin;
  const float3 oc = c - cast->base - cast->origin;
  const float az = ox_axis(oa, cast->kz);
  const float bz = ox_axis(ob, cast->kz);
  const float cz = ox_axis(oc, cast->kz);
  // One expression per corner: all triangles at a corner get the same bits.
  const float ax = fma(-cast->sx, az, ox_axis(oa, cast->kx));
  const float ay = fma(-cast->sy, az, ox_axis(oa, cast->ky));
  const float bx = fma(-cast->sx, bz, ox_axis(ob, cast->kx));
  const float by = fma(-cast->sy, bz, ox_axis(ob, cast->ky));
  const float cx = fma(-cast->sx, cz, ox_axis(oc, cast->kx));
  const float cy = fma(-cast->sy, cz, ox_axis(oc, cast->ky));
  const float u = ox_det2(cx, by, cy, bx);
  const float v = ox_det2(ax, cy, ay, cx);
  const float w = ox_det2(bx, ay, by, ax);
  if ((u < 0.0f || v < 0.0f || w < 0.0f) && (u > 0.0f || v > 0.0f || w > 0.0f)) return false;
  const float determinant = u + v + w;
  if (determinant == 0.0f) return false;  // edge on: its neighbours are met
  *t = (u * az + v * bz + w * cz) * cast->sz / determinant;
  *back = determinant < 0.0f;
  // Products of three lengths overflow long before lengths do; what has no distance is no hit.
  return fabs(*t) < INFINITY;
}

#endif
