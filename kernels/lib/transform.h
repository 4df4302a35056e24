// SPDX-License-Identifier: BSD-3-Clause
// Vectors, and what turns points of the source mesh into the frame of the target mesh: side 0
// is A against B, side 1 B against A. Device only. One definition
// for all steps, so that every step sees the same bits. dot() and cross() of OpenCL have no error
// bound per component and may be contracted; these are not.
#ifndef ODE_EXT_KERNELS_LIB_TRANSFORM_H
#define ODE_EXT_KERNELS_LIB_TRANSFORM_H

#include "abi/types.h"

static inline float ox_dot(float3 a, float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

static inline float3 ox_plain_cross(float3 a, float3 b) {
  return (float3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline float ox_max(float a, float b) { return a > b ? a : b; }
static inline float ox_min(float a, float b) { return a < b ? a : b; }

static inline float3 ox_rotate(__global const ox_pair* pair, uint side, float3 v) {
  __global const float* rotation = pair->rotation[side];
  return (float3)(ox_dot(vload3(0, rotation), v), ox_dot(vload3(1, rotation), v),
                  ox_dot(vload3(2, rotation), v));
}

// From the origins of both meshes.
static inline float3 ox_transform(__global const ox_pair* pair, uint side, float3 p) {
  return ox_rotate(pair, side, p) + vload3(0, pair->offset[side]);
}

// From their bases (abi/types.h).
static inline float3 ox_transform_from_base(__global const ox_pair* pair, uint side, float3 p) {
  return ox_rotate(pair, side, p) + vload3(0, pair->base_offset[side]);
}

static inline float3 ox_base(__global const ox_pair* pair, uint side) {
  return vload3(0, pair->base[side]);
}

// A point as a mesh has it, from its base on, and in the frame of the other mesh, from the other's.
static inline float3 ox_from_base(__global const ox_pair* pair, uint side, float3 p) {
  return p - ox_base(pair, side);
}
static inline float3 ox_place(__global const ox_pair* pair, uint side, float3 p) {
  return ox_transform_from_base(pair, side, ox_from_base(pair, side, p));
}

// Half extents of a turned box.
static inline float3 ox_rotate_extents(__global const ox_pair* pair, uint side, float3 h) {
  __global const float* rotation = pair->rotation[side];
  return (float3)(ox_dot(fabs(vload3(0, rotation)), h), ox_dot(fabs(vload3(1, rotation)), h),
                  ox_dot(fabs(vload3(2, rotation)), h));
}

#endif
