// SPDX-License-Identifier: BSD-3-Clause
// What the kernels that follow moved vertices have in common. Device only.
#ifndef ODE_EXT_KERNELS_LIB_MOVES_H
#define ODE_EXT_KERNELS_LIB_MOVES_H

#include "abi/deform.h"
#include "lib/transform.h"

// The move that an item belongs to. The starts of a launch: starts[m] is the first item of move m,
// starts[count] the number of items.
static inline uint ox_move_of(__global const uint* starts, uint count, uint item) {
  uint low = 0u;
  uint high = count;
  while (high - low > 1u) {
    const uint middle = (low + high) / 2u;
    if (starts[middle] <= item)
      low = middle;
    else
      high = middle;
  }
  return low;
}

// Divided by the largest component first, so that no square over- or underflows.
static inline float ox_norm(float3 v) {
  const float3 size = fabs(v);
  const float largest = ox_max(ox_max(size.x, size.y), size.z);
  if (largest == 0.0f) return 0.0f;
  const float3 u = v / largest;
  return largest * sqrt(ox_dot(u, u));
}

#endif
