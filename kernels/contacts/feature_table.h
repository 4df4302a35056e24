// SPDX-License-Identifier: BSD-3-Clause
// The features of all pairs by what they are of: a hash table with open addressing, filled by many
// work-items at a time. Device only.
//
// An entry is feature << 2 | what it is by. Of those with the same key the first to come is in the
// table, so nothing may depend on which that is.
#ifndef ODE_EXT_KERNELS_CONTACTS_FEATURE_TABLE_H
#define ODE_EXT_KERNELS_CONTACTS_FEATURE_TABLE_H

#include "contacts/feature.h"

#define OX_ENTRY_FIRST_FACETS 0u   // the facet crossed and the first, or
#define OX_ENTRY_SECOND_FACETS 1u  // the second at the edge: of mesh A, of mesh B
#define OX_ENTRY_EDGE 2u           // side, edge
#define OX_ENTRY_VERTEX 3u         // side, vertex

typedef struct {
  uint pair;
  uint kind;  // OX_ENTRY_..., for either facets OX_ENTRY_FIRST_FACETS
  uint first, second;
} ox_feature_key;

static inline ox_feature_key ox_facets_key(uint pair, uint side, uint at, uint crossed) {
  const ox_feature_key key = {pair, OX_ENTRY_FIRST_FACETS, side == 0u ? at : crossed,
                              side == 0u ? crossed : at};
  return key;
}

static inline ox_feature_key ox_edge_key(uint pair, uint side, uint edge) {
  const ox_feature_key key = {pair, OX_ENTRY_EDGE, side, edge};
  return key;
}

static inline ox_feature_key ox_inside_key(uint pair, uint side, uint vertex) {
  const ox_feature_key key = {pair, OX_ENTRY_VERTEX, side, vertex};
  return key;
}

static inline ox_feature_key ox_key_of_feature(const ox_scene* scene, uint entry) {
  __global const ox_feature* f = scene->features + (entry >> 2);
  const uint by = entry & 3u;
  const uint side = ox_side_of(f->flags);
  if (by == OX_ENTRY_EDGE) return ox_edge_key(f->pair, side, f->source);
  if (by == OX_ENTRY_VERTEX) return ox_inside_key(f->pair, side, f->source);
  return ox_facets_key(f->pair, side, ox_facet_of(scene, f->at[by]),
                       ox_facet_of(scene, f->triangle));
}

static inline uint ox_hash_of(ox_feature_key key) {
  // Multiplicative (Knuth), one odd constant after the other.
  uint h = key.pair * 4u + key.kind;
  h = (h ^ h >> 15) * 0x9e3779b1u + key.first;
  h = (h ^ h >> 15) * 0x85ebca6bu + key.second;
  h = (h ^ h >> 15) * 0xc2b2ae35u;
  return h ^ h >> 16;
}

// Each pair has a stretch of the table, so that what is looked up together lies together.
typedef struct {
  uint first, count;
} ox_stretch;

static inline ox_stretch ox_slots_of(const ox_scene* scene, uint pair) {
  const ox_stretch stretch = {OX_SLOTS_PER_FEATURE * scene->found[pair].first,
                              OX_SLOTS_PER_FEATURE * scene->found[pair].features};
  return stretch;
}

static inline bool ox_is_key(const ox_scene* scene, uint entry, ox_feature_key key) {
  const ox_feature_key there = ox_key_of_feature(scene, entry);
  return there.pair == key.pair && there.kind == key.kind && there.first == key.first &&
         there.second == key.second;
}

// The entry with a key; OX_NONE: there is none.
static inline uint ox_find_feature(const ox_scene* scene, ox_feature_key key) {
  const ox_stretch of = ox_slots_of(scene, key.pair);
  if (of.count == 0u) return OX_NONE;
  for (uint slot = mul_hi(ox_hash_of(key), of.count);;
       slot = slot + 1u < of.count ? slot + 1u : 0u) {
    const uint entry = scene->slots[of.first + slot];
    if (entry == OX_NONE || ox_is_key(scene, entry, key)) return entry;
  }
}

// Puts an entry in, unless there is one with its key: which it returns, else OX_NONE.
static inline uint ox_add_feature(const ox_scene* scene, uint entry) {
  const ox_feature_key key = ox_key_of_feature(scene, entry);
  const ox_stretch of = ox_slots_of(scene, key.pair);
  for (uint slot = mul_hi(ox_hash_of(key), of.count);;
       slot = slot + 1u < of.count ? slot + 1u : 0u) {
    uint there = scene->slots[of.first + slot];
    if (there == OX_NONE)
      there = ox_compare_exchange(scene, scene->slots + of.first + slot, OX_NONE, entry);
    if (there == OX_NONE || ox_is_key(scene, there, key)) return there;
  }
}

#endif
