// SPDX-License-Identifier: BSD-3-Clause
// Append lists: a counter each, records behind it. Device only.
#ifndef ODE_EXT_KERNELS_SHARED_APPEND_H
#define ODE_EXT_KERNELS_SHARED_APPEND_H

#include "shared/transform.h"

// More is not counted: a counter that ran past 2^32 would begin again.
#define OX_MOST_COUNTED 0x80000000u

// Where the next record of a list goes; OX_NONE: it is full, and the counter says by how much.
static inline uint ox_append(__global volatile uint* counters, __global const ox_list* lists,
                             uint list) {
  __global volatile uint* counter = counters + list * OX_COUNTER_STRIDE;
  const uint slot = atomic_inc(counter);
  if (slot >= OX_MOST_COUNTED) atomic_dec(counter);
  return slot < lists[list].capacity ? lists[list].first + slot : OX_NONE;
}

static inline uint ox_length(__global const volatile uint* counters, __global const ox_list* lists,
                             uint list) {
  return min(counters[list * OX_COUNTER_STRIDE], lists[list].capacity);
}

static inline void ox_count(__global volatile uint* counters, uint counter) {
  atomic_inc(counters + counter * OX_COUNTER_STRIDE);
}

// The next of the items that no work-item has taken. For work of which one item may be a thousand
// times the next: on a processor a work-group is one thread's, whatever is in it, and the others
// would have nothing left to do.
static inline uint ox_next_item(__global volatile uint* counters, uint queue) {
  return atomic_inc(counters + queue * OX_COUNTER_STRIDE);
}

// Keeps what a work-item did, in programs built to count it.
static inline void ox_note_work(__global ox_work* works, uint item, const ox_work* work) {
#ifdef OX_COUNT_WORK
  works[item] = *work;
#else
  (void)works;
  (void)item;
  (void)work;
#endif
}

// The list of the full algorithm for the target of a ray.
static inline uint ox_full_list(__global const ox_pair* pairs, __global const ox_mesh* meshes,
                                uint pair_side, uint rays_mode) {
  __global const ox_mesh* target = meshes + pairs[pair_side >> 1].mesh[1u - (pair_side & 1u)];
  return (target->flags & OX_MESH_DEFORMABLE) != 0u && (rays_mode & OX_RAYS_BASIC) != 0u
             ? OX_LIST_RAYS_BASIC
             : OX_LIST_RAYS_BVH;
}

#endif
