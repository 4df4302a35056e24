// SPDX-License-Identifier: BSD-3-Clause
// General position (docs/contacts.md): the meshes of a pair are put so that nothing of one
// only touches the other. What touches overlaps, and what coincides crosses. Device only.
//
// Everything is in the frame of B. Mesh A is taken a little larger, and all coordinates are rounded
// to a grid on which their differences are exact floats: so signs are decided exactly
// (lib/exact_sign.h).
#ifndef ODE_EXT_KERNELS_LIB_GENERAL_POSITION_H
#define ODE_EXT_KERNELS_LIB_GENERAL_POSITION_H

#include "lib/transform.h"

// What rounding can do to a coordinate, in parts of how large coordinates are (pair_step.cl).
#define OX_ROUNDING 0x1p-20f

// [m] how far each vertex of A is moved out along its normal. A face at it moves by the cosine
// between them: 0.58 at the corner of a cube, 1.15 epsilons. The grid takes half of one from what
// touches, a quarter for each mesh, and the roundings of a coordinate a fraction of another: the
// bound of 16 of them (pair_step.cl) is hardly ever neared.
#define OX_INFLATION 2.0f  // epsilons
// What is farther apart than this does not meet: A's growth, and what is not known.
#define OX_MARGIN (2.0f * OX_INFLATION)
// What a plane clears may be so far above it, and depths that differ by no more are the same. Where
// two faces meet features of the one come up to the margin above the other: at the margin itself
// rounding would choose.
#define OX_CLEARANCE (2.0f * OX_MARGIN)

// What a pair's coordinates are rounded by: x + snap - snap. With a power of two P of twice the
// largest of them at least, snap is 1.5 P; sums with it lie between P and 2 P, where floats are
// 2^-23 P apart. That is the grid: half an epsilon at most. Coordinates are 2^22 of it at most,
// their differences 2^23.
static inline float ox_snap_of(float largest) {
  const uint bits = as_uint(2.0f * largest) + 0x007fffffu;
  return 1.5f * as_float(bits & 0x7f800000u);
}

// [m] what the largest coordinate may be: half of P.
static inline float ox_largest_of(float snap) { return snap / 3.0f; }

// [m] the grid: 1.5 P has the exponent of P.
static inline float ox_grid_of(float snap) {
  return as_float(as_uint(snap) & 0x7f800000u) * 0x1p-23f;
}

#endif
