// SPDX-License-Identifier: BSD-3-Clause
// Orders of the crossings of a pair, by side first. What is sorted has its key beside it, so that
// few crossings have to be looked up. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_CROSSING_ORDER_H
#define ODE_EXT_KERNELS_SHARED_CROSSING_ORDER_H

#include "shared/edge_pair.h"

#define OX_BY_EDGE 0u   // and along it
#define OX_BY_FACET 1u  // that is crossed, and then by edge

typedef struct {
  __global uint* entries;  // crossings
  __global uint* keys;
  uint count;
  uint by;
} ox_order;

// Of a side and what comes next. The index has 31 bits: 2^31 edges would come with 1.4e9 triangles,
// of more than 100 bytes each.
static inline uint ox_order_key(const ox_edge_pair* p, uint by, uint crossing) {
  __global const ox_pair_crossing* c = p->crossings + crossing;
  return ox_side(c) << 31 | ((by == OX_BY_EDGE ? c->edge : c->facet) & 0x7fffffffu);
}

// Of two with the same key.
static inline bool ox_comes_before(const ox_edge_pair* p, uint i, uint j) {
  __global const ox_pair_crossing* a = p->crossings + i;
  __global const ox_pair_crossing* b = p->crossings + j;
  if (a->edge != b->edge) return a->edge < b->edge;
  if (a->t != b->t) return a->t < b->t;
  return a->triangle < b->triangle;
}

// Puts an entry into the heap of the first `end`, at `root` or below.
static inline void ox_sift(const ox_edge_pair* p, const ox_order* order, uint root, uint end,
                           uint entry, uint key) {
  __global uint* entries = order->entries;
  __global uint* keys = order->keys;
  for (uint child = 2u * root + 1u; child < end; child = 2u * root + 1u) {
    if (child + 1u < end &&
        (keys[child] != keys[child + 1u] ? keys[child] < keys[child + 1u]
                                         : ox_comes_before(p, entries[child], entries[child + 1u])))
      ++child;
    if (key != keys[child] ? key > keys[child] : !ox_comes_before(p, entry, entries[child])) break;
    entries[root] = entries[child];
    keys[root] = keys[child];
    root = child;
  }
  entries[root] = entry;
  keys[root] = key;
}

// Heap sort: no recursion, no memory but for the keys.
static inline void ox_sort_crossings(const ox_edge_pair* p, const ox_order* order) {
  __global uint* entries = order->entries;
  __global uint* keys = order->keys;
  for (uint i = 0u; i < order->count; ++i) keys[i] = ox_order_key(p, order->by, entries[i]);
  for (uint i = order->count / 2u; i-- > 0u;)
    ox_sift(p, order, i, order->count, entries[i], keys[i]);
  for (uint end = order->count; end > 1u; --end) {
    const uint entry = entries[end - 1u];
    const uint key = keys[end - 1u];
    entries[end - 1u] = entries[0];
    keys[end - 1u] = keys[0];
    ox_sift(p, order, 0u, end - 1u, entry, key);
  }
}

#endif
#endif
