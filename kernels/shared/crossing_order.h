// SPDX-License-Identifier: BSD-3-Clause
// Orders of the crossings of a pair, by side first. What is sorted has its key beside it, so that
// few crossings have to be looked up. Device only.
#ifndef ODE_EXT_KERNELS_SHARED_CROSSING_ORDER_H
#define ODE_EXT_KERNELS_SHARED_CROSSING_ORDER_H

#include "shared/edge_pair.h"

#define OX_BY_EDGE 0u          // and along it
#define OX_BY_FACET 1u         // that is crossed, and then by edge
#define OX_BY_FACETS 2u        // that is crossed, that which the edge is at, and then by edge
#define OX_BY_FIRST_VERTEX 3u  // of the edge
#define OX_BY_SECOND_VERTEX 4u
#define OX_BY_INNER_VERTEX 5u  // at the end of the chord

// Entries and their keys.
typedef struct {
  __global uint* entries;  // crossings; by facets, crossing << 1 | which facet of the edge
  __global uint* keys;
  uint count;
  uint by;
} ox_order;

// The vertex inside at the end of the chord; OX_NONE: both ends are crossings.
static inline uint ox_inner_vertex(const ox_edge_pair* p, __global const ox_edge_crossing* c) {
  if (c->other != OX_NONE) return OX_NONE;
  return p->edges[c->edge].vertex[c->leaves != 0u ? 0u : 1u];
}

// Of a side and what comes next. The index has 31 bits: 2^31 edges would come with 1.4e9 triangles,
// of more than 100 bytes each. OX_NONE comes last.
static inline uint ox_key_of(uint side, uint index) { return side << 31 | (index & 0x7fffffffu); }

static inline uint ox_order_key(const ox_edge_pair* p, uint by, uint entry) {
  __global const ox_edge_crossing* c = p->crossings + (by == OX_BY_FACETS ? entry >> 1 : entry);
  uint index;
  if (by == OX_BY_EDGE)
    index = c->edge;
  else if (by == OX_BY_INNER_VERTEX)
    index = ox_inner_vertex(p, c);
  else if (by == OX_BY_FIRST_VERTEX || by == OX_BY_SECOND_VERTEX)
    index = p->edges[c->edge].vertex[by - OX_BY_FIRST_VERTEX];
  else
    index = c->facet;
  return ox_key_of(ox_side(c), index);
}

// Of two entries with the same key.
static inline bool ox_comes_before(const ox_edge_pair* p, uint by, uint i, uint j) {
  const uint shift = by == OX_BY_FACETS ? 1u : 0u;
  __global const ox_edge_crossing* a = p->crossings + (i >> shift);
  __global const ox_edge_crossing* b = p->crossings + (j >> shift);
  if (by == OX_BY_FACETS) {
    const uint at_a = ox_facet_at(p, a->edge, i & 1u);
    const uint at_b = ox_facet_at(p, b->edge, j & 1u);
    if (at_a != at_b) return at_a < at_b;
  }
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
        (keys[child] != keys[child + 1u]
             ? keys[child] < keys[child + 1u]
             : ox_comes_before(p, order->by, entries[child], entries[child + 1u])))
      ++child;
    if (key != keys[child] ? key > keys[child]
                           : !ox_comes_before(p, order->by, entry, entries[child]))
      break;
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

// The first place whose key is not less.
static inline uint ox_first_with(__global const uint* keys, uint count, uint key) {
  uint low = 0u;
  uint high = count;
  while (low < high) {
    const uint middle = (low + high) / 2u;
    if (keys[middle] < key)
      low = middle + 1u;
    else
      high = middle;
  }
  return low;
}

#endif
