// SPDX-License-Identifier: BSD-3-Clause
// What several work-items may change at once. Where one of them has the scene to itself
// (whole_step.cl) nobody else is there to change it, and a locked instruction, which a processor
// waits for, would be one for nothing: `alone`. Device only.
#ifndef ODE_EXT_KERNELS_LIB_ATOMICS_H
#define ODE_EXT_KERNELS_LIB_ATOMICS_H

#include "lib/group.h"
#include "lib/scene.h"

// All return what was there. Where a work-group goes through an item together it is done once, for
// all of it.
#define OX_RETURN_ONCE(operation)              \
  do {                                         \
    uint was = 0u;                             \
    if (ox_is_first_item()) was = (operation); \
    return ox_of_item(was, 0u);                \
  } while (0)

static inline uint ox_fetch(__global volatile uint* at) { OX_RETURN_ONCE(*at); }

// Whoever else is there: of what belongs to all work-items.
static inline uint ox_fetch_add_shared(__global volatile uint* at, uint more) {
  OX_RETURN_ONCE(atomic_add(at, more));
}

static inline uint ox_fetch_add(const ox_scene* scene, __global volatile uint* at, uint more) {
  if (!scene->alone) return ox_fetch_add_shared(at, more);
  const uint was = *at;
  *at = was + more;
  return was;
}

// The same by each work-item for itself.
static inline uint ox_fetch_add_own(const ox_scene* scene, __global volatile uint* at, uint more) {
  if (!scene->alone) return atomic_add(at, more);
  const uint was = *at;
  *at = was + more;
  return was;
}

static inline uint ox_exchange(const ox_scene* scene, __global volatile uint* at, uint value) {
  if (!scene->alone) OX_RETURN_ONCE(atomic_xchg(at, value));
  const uint was = *at;
  *at = value;
  return was;
}

// Where that is `expected` it becomes `value`.
static inline uint ox_compare_exchange(const ox_scene* scene, __global volatile uint* at,
                                       uint expected, uint value) {
  if (!scene->alone) OX_RETURN_ONCE(atomic_cmpxchg(at, expected, value));
  const uint was = *at;
  if (was == expected) *at = value;
  return was;
}

static inline uint ox_fetch_min(const ox_scene* scene, __global volatile uint* at, uint value) {
  if (!scene->alone) OX_RETURN_ONCE(atomic_min(at, value));
  const uint was = *at;
  *at = min(was, value);
  return was;
}

static inline uint ox_fetch_or(const ox_scene* scene, __global volatile uint* at, uint bits) {
  if (!scene->alone) OX_RETURN_ONCE(atomic_or(at, bits));
  const uint was = *at;
  *at = was | bits;
  return was;
}

#endif
