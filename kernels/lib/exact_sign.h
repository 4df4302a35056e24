// SPDX-License-Identifier: BSD-3-Clause
// Whether an edge crosses a triangle, decided exactly. Device only.
//
// Coordinates are whole numbers of the grid of the pair (lib/general_position.h), below 2^22.
// Their differences are below 2^23, 2x2 minors of those below 2^47, a determinant below 2^71: two
// words of 64 bits hold it. Where one is 0, mesh A is taken to be moved by an infinitely small
// shift, as Edelsbrunner and Muecke ("Simulation of Simplicity", 1990) move every point by its own:
// what two meshes are to one another only changes by a motion of one of them, and a common shift
// keeps the signs of all their triangles those of one real configuration. So two triangles that
// cross have two crossings, and the curve in which two surfaces meet is closed.
#ifndef ODE_EXT_KERNELS_LIB_EXACT_SIGN_H
#define ODE_EXT_KERNELS_LIB_EXACT_SIGN_H

#include "lib/general_position.h"

typedef struct {
  long x, y, z;
} ox_whole;

static inline ox_whole ox_whole_of(float3 p, float per_grid) {
  ox_whole w;
  w.x = (long)(p.x * per_grid);
  w.y = (long)(p.y * per_grid);
  w.z = (long)(p.z * per_grid);
  return w;
}

static inline ox_whole ox_whole_difference(ox_whole a, ox_whole b) {
  ox_whole d;
  d.x = a.x - b.x;
  d.y = a.y - b.y;
  d.z = a.z - b.z;
  return d;
}

static inline ox_whole ox_whole_cross(ox_whole a, ox_whole b) {
  ox_whole c;
  c.x = a.y * b.z - a.z * b.y;
  c.y = a.z * b.x - a.x * b.z;
  c.z = a.x * b.y - a.y * b.x;
  return c;
}

static inline int ox_sign_of(long v) { return v > 0L ? 1 : v < 0L ? -1 : 0; }

// The sign of a . b, a below 2^48 and b below 2^23.
static inline int ox_whole_dot_sign(ox_whole a, ox_whole b) {
  const long factor[6] = {a.x, b.x, a.y, b.y, a.z, b.z};
  long high = 0L;
  ulong low = 0ul;
  for (uint k = 0u; k < 3u; ++k) {
    const ulong product = (ulong)factor[2u * k] * (ulong)factor[2u * k + 1u];
    low += product;
    high += mul_hi(factor[2u * k], factor[2u * k + 1u]) + (low < product ? 1L : 0L);
  }
  return high != 0L || low == 0ul ? ox_sign_of(high) : 1;
}

// The shift of A is along this: of primes, so that hardly any vector is at right angles to it.
// Below 2^11: times a minor, three of them, below 2^60.
static inline int ox_shift_sign(ox_whole v, uint side) {
  const int sign = ox_sign_of(577L * v.x + 769L * v.y + 1283L * v.z);
  return side == 0u ? sign : -sign;
}

// Above (1) or below (-1) the plane of a triangle; the point is of mesh `side`, the triangle of the
// other. What the shift leaves at 0 counts as above: so does any point over a triangle of no area,
// which nothing crosses.
static int ox_exact_height_sign(uint side, ox_whole p, ox_whole a, ox_whole b, ox_whole c) {
  const ox_whole n = ox_whole_cross(ox_whole_difference(b, a), ox_whole_difference(c, a));
  int sign = ox_whole_dot_sign(n, ox_whole_difference(p, a));
  if (sign == 0) sign = ox_shift_sign(n, side);
  return sign == 0 ? 1 : sign;
}

// On which side of the line through r and s the line from p along d passes; p is of mesh `side`, r
// and s of the other. 0: they are parallel, and in one plane.
static int ox_exact_pass_sign(uint side, ox_whole d, ox_whole p, ox_whole r, ox_whole s) {
  const ox_whole to_r = ox_whole_difference(r, p);
  const ox_whole to_s = ox_whole_difference(s, p);
  const int sign = ox_whole_dot_sign(ox_whole_cross(to_r, to_s), d);
  if (sign != 0) return sign;
  // d . ((r - shift) x (s - shift)) less what it was: shift . (d x (s - r))
  return ox_shift_sign(ox_whole_cross(d, ox_whole_difference(s, r)), side);
}

#define OX_NO_CROSSING 0u
#define OX_CROSSING_IN 1u
#define OX_CROSSING_OUT 2u

// How the edge from p to q, of mesh `side`, crosses the triangle of the other.
static __attribute__((noinline)) uint ox_cross_exactly(__global const ox_pair* pair, uint side,
                                                       float3 p, float3 q, float3 a, float3 b,
                                                       float3 c) {
  const float per_grid = 1.0f / ox_grid_of(pair->snap);
  const ox_whole wp = ox_whole_of(p, per_grid);
  const ox_whole wq = ox_whole_of(q, per_grid);
  const ox_whole wa = ox_whole_of(a, per_grid);
  const ox_whole wb = ox_whole_of(b, per_grid);
  const ox_whole wc = ox_whole_of(c, per_grid);
  const int from = ox_exact_height_sign(side, wp, wa, wb, wc);
  if (from == ox_exact_height_sign(side, wq, wa, wb, wc)) return OX_NO_CROSSING;
  // Out by the back, where it passes all edges on their left, or in by the front, on their right.
  const int passes = -from;
  const ox_whole d = ox_whole_difference(wq, wp);
  if (ox_exact_pass_sign(side, d, wp, wb, wc) != passes ||
      ox_exact_pass_sign(side, d, wp, wc, wa) != passes ||
      ox_exact_pass_sign(side, d, wp, wa, wb) != passes)
    return OX_NO_CROSSING;
  return passes > 0 ? OX_CROSSING_OUT : OX_CROSSING_IN;
}

#endif
