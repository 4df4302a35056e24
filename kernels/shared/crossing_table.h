// SPDX-License-Identifier: BSD-3-Clause
// The crossings of a pair by something that they have: which of them have it too? A hash table of
// chains. Device only.
//
// Room: three slots and two links for each crossing.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_CROSSING_TABLE_H
#define ODE_EXT_KERNELS_SHARED_CROSSING_TABLE_H

#include "shared/edge_pair.h"

// What an entry of the table is by: crossing << 1 | k.
#define OX_BY_FACETS \
  0u                           // a pair of facets that the curve runs through: the one that is \
                               // crossed, and the one at the edge, k
#define OX_BY_INNER_VERTEX 1u  // the vertex inside at the end of the chord
#define OX_BY_FIRST_VERTEX 2u  // of the edge
#define OX_BY_SECOND_VERTEX 3u

// The vertex inside at the end of the chord; OX_NONE: both ends are crossings.
static inline uint ox_inner_vertex(const ox_edge_pair* p, __global const ox_pair_crossing* c) {
  if (c->other != OX_NONE) return OX_NONE;
  return p->edges[c->edge].vertex[ox_leaves(c) ? 0u : 1u];
}

typedef struct {
  uint first, second;  // of facets: of mesh A, of mesh B; else a side and a vertex. OX_NONE: none
} ox_crossing_key;

static inline ox_crossing_key ox_facets_key(uint side, uint at, uint crossed) {
  ox_crossing_key key;
  key.first = side == 0u ? at : crossed;
  key.second = side == 0u ? crossed : at;
  return key;
}

static inline ox_crossing_key ox_vertex_key(uint side, uint vertex) {
  ox_crossing_key key;
  key.first = vertex == OX_NONE ? OX_NONE : side;
  key.second = vertex;
  return key;
}

static inline ox_crossing_key ox_key_of_entry(const ox_edge_pair* p, uint by, uint entry) {
  __global const ox_pair_crossing* c = p->crossings + (entry >> 1);
  const uint k = entry & 1u;
  if (by == OX_BY_FACETS) return ox_facets_key(ox_side(c), c->at[k], c->facet);
  if (by == OX_BY_INNER_VERTEX) return ox_vertex_key(ox_side(c), ox_inner_vertex(p, c));
  return ox_vertex_key(ox_side(c), p->edges[c->edge].vertex[by - OX_BY_FIRST_VERTEX]);
}

static inline uint ox_crossing_slots(const ox_edge_pair* p) { return 3u * p->count; }

// The slot where the chain of a key begins, or would.
static inline uint ox_slot_of_key(const ox_edge_pair* p, ox_crossing_key key) {
  const uint slots = ox_crossing_slots(p);
  // Multiplicative (Knuth), the golden ratio and the square root of 2; the high half of a product
  // with the number of slots is one of them.
  uint slot = mul_hi((key.first * 0x9e3779b1u + key.second) * 0xb504f333u, slots);
  for (;; slot = slot + 1u < slots ? slot + 1u : 0u) {
    const uint entry = p->table.slots[slot];
    if (entry == OX_NONE) return slot;
    const ox_crossing_key there = ox_key_of_entry(p, p->table.by, entry);
    if (there.first == key.first && there.second == key.second) return slot;
  }
}

// The first entry with a key, and the next after an entry; OX_NONE: there are no more.
static inline uint ox_first_entry(const ox_edge_pair* p, ox_crossing_key key) {
  return p->table.slots[ox_slot_of_key(p, key)];
}
static inline uint ox_next_entry(const ox_edge_pair* p, uint entry) { return p->table.next[entry]; }

static inline void ox_add_entry(const ox_edge_pair* p, uint entry) {
  const ox_crossing_key key = ox_key_of_entry(p, p->table.by, entry);
  if (key.first == OX_NONE || key.second == OX_NONE) return;
  const uint slot = ox_slot_of_key(p, key);
  p->table.next[entry] = p->table.slots[slot];
  p->table.slots[slot] = entry;
}

// Chains go along `order`. In the room of points, of which there are none yet.
static inline void ox_tabulate_crossings(ox_edge_pair* p, uint by) {
  p->table.slots = p->point_of_region;
  p->table.next = p->table.slots + ox_crossing_slots(p);
  p->table.by = by;
  for (uint i = 0u; i < ox_crossing_slots(p); ++i) p->table.slots[i] = OX_NONE;
  for (uint i = p->count; i-- > 0u;) {
    const uint crossing = p->order[i];
    __global const ox_pair_crossing* c = p->crossings + crossing;
    if (by == OX_BY_FACETS && c->at[1] != c->at[0]) ox_add_entry(p, crossing << 1 | 1u);
    ox_add_entry(p, crossing << 1);
  }
}

#endif
#endif
