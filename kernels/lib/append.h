// SPDX-License-Identifier: BSD-3-Clause
// Append lists: a counter each, records behind it. Device only.
#ifndef ODE_EXT_KERNELS_LIB_APPEND_H
#define ODE_EXT_KERNELS_LIB_APPEND_H

#include "lib/atomics.h"

// Where the next record of a list goes; OX_NONE: it is full, and the counter says by how much.
static inline uint ox_append(const ox_scene* scene, uint list) {
  __global volatile uint* counter = scene->counters + list * OX_COUNTER_STRIDE;
  const uint index = ox_fetch_add(scene, counter, 1u);
  if (index >= OX_MOST_COUNTED) ox_fetch_add_shared(counter, ~0u);
  return index < scene->lists[list].capacity ? scene->lists[list].first + index : OX_NONE;
}

// The same for so many at once: a counter that all threads add to is what appending one by one
// waits for. `stored` becomes how many of them there is room for, from the place on that it gives.
#define OX_MOST_AT_ONCE 16u
static inline uint ox_append_many(const ox_scene* scene, uint list, uint count, uint* stored) {
  __global volatile uint* counter = scene->counters + list * OX_COUNTER_STRIDE;
  const uint first = ox_fetch_add(scene, counter, count);
  if (first >= OX_MOST_COUNTED) ox_fetch_add_shared(counter, 0u - count);
  const uint capacity = scene->lists[list].capacity;
  *stored = first < capacity ? min(count, capacity - first) : 0u;
  return scene->lists[list].first + first;
}

// The same of each work-item of a group that wants to: OX_NONE where it does not.
static inline uint ox_append_each(const ox_scene* scene, uint list, bool wants) {
  const uint bits = ox_group_bits(wants);
  if (bits == 0u) return OX_NONE;
  uint stored;
  const uint first = ox_append_many(scene, list, popcount(bits), &stored);
  const uint before = popcount(bits & ((1u << OX_ITEM) - 1u));
  return wants && before < stored ? first + before : OX_NONE;
}

static inline uint ox_length(const ox_scene* scene, uint list) {
  return min(scene->counters[list * OX_COUNTER_STRIDE], scene->lists[list].capacity);
}

static inline void ox_count(const ox_scene* scene, uint counter) {
  ox_fetch_add(scene, scene->counters + counter * OX_COUNTER_STRIDE, 1u);
}

// Room for so many in one go: the first of their places.
static inline uint ox_take_room(const ox_scene* scene, uint counter, uint count) {
  return ox_fetch_add(scene, scene->counters + counter * OX_COUNTER_STRIDE, count);
}

// The next of the items that no work-item has taken. For work of which one item may be a thousand
// times the next: on a processor a work-group is one thread's, whatever is in it, and the others
// would have nothing left to do.
static inline uint ox_next_item(const ox_scene* scene, uint queue) {
  return ox_fetch_add(scene, scene->counters + queue * OX_COUNTER_STRIDE, 1u);
}

#endif
