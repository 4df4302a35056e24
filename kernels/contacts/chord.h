// SPDX-License-Identifier: BSD-3-Clause
// Chords: the stretches of an edge that are inside the other mesh. Device only.
//
// A crossing by which the edge enters and the next by which it leaves are the two ends of one, to
// within what rounding may have moved them; of crossings at one place the lowest triangle's.
#ifndef ODE_EXT_KERNELS_CONTACTS_CHORD_H
#define ODE_EXT_KERNELS_CONTACTS_CHORD_H

#include "contacts/feature_table.h"

// How an edge is walked: `sign` 1 from its first vertex on, -1 from its second.
static inline bool ox_comes_before(__global const ox_feature* a, __global const ox_feature* b,
                                   float sign) {
  return a->t != b->t ? sign * a->t < sign * b->t : a->triangle < b->triangle;
}

// Two chains in order, as one.
static inline uint ox_merge_chains(__global ox_feature* features, uint a, uint b, float sign) {
  uint head = OX_NONE;
  uint last = OX_NONE;
  while (a != OX_NONE && b != OX_NONE) {
    const bool takes_b = ox_comes_before(features + b, features + a, sign);
    const uint taken = takes_b ? b : a;
    if (takes_b)
      b = features[b].next;
    else
      a = features[a].next;
    if (last == OX_NONE)
      head = taken;
    else
      features[last].next = taken;
    last = taken;
  }
  const uint rest = a != OX_NONE ? a : b;
  if (last == OX_NONE) return rest;
  features[last].next = rest;
  return head;
}

// Puts the crossings of an edge in order (merge sort, from the bottom up); returns the first.
static inline uint ox_sort_chain(__global ox_feature* features, uint head, float sign) {
  uint sorted[32];  // of 2^i each; OX_NONE: there is none
  for (uint i = 0u; i < 32u; ++i) sorted[i] = OX_NONE;
  while (head != OX_NONE) {
    uint chain = head;
    head = features[head].next;
    features[chain].next = OX_NONE;
    uint i = 0u;
    for (; i < 31u && sorted[i] != OX_NONE; ++i) {
      chain = ox_merge_chains(features, sorted[i], chain, sign);
      sorted[i] = OX_NONE;
    }
    sorted[i] = chain;
  }
  uint all = OX_NONE;
  for (uint i = 0u; i < 32u; ++i) all = ox_merge_chains(features, sorted[i], all, sign);
  return all;
}

// The vertex at the end of an edge that is on the inner side of a crossing, if it is inside.
static inline uint ox_find_end_inside(const ox_scene* scene, __global const ox_feature* features,
                                      __global const uint* slots, __global const ox_feature* f) {
  const bool leaves = (f->flags & OX_FEATURE_LEAVES) != 0u;
  const uint vertex = scene->edges[f->source].vertex[leaves ? 0u : 1u];
  const uint entry =
      ox_find_feature(scene, features, slots, ox_inside_key(f->pair, ox_side_of(f->flags), vertex));
  return entry == OX_NONE ? OX_NONE : entry >> 2;
}

// Partners of those crossings of an edge by which it enters, as it is walked. Those before what
// may be the other end of one may not be that of a later one either.
static inline void ox_pair_crossings(const ox_scene* scene, __global ox_feature* features,
                                     __global const uint* slots,
                                     __global const ox_edge_crossing* crossings, uint first,
                                     float sign) {
  float blur = 0.0f;
  for (uint i = first; i != OX_NONE; i = features[i].next) blur = ox_max(blur, crossings[i].blur);
  uint from = first;
  for (uint i = first; i != OX_NONE; i = features[i].next) {
    __global ox_feature* f = features + i;
    if (((f->flags & OX_FEATURE_LEAVES) == 0u) != (sign > 0.0f)) continue;
    while (sign * features[from].t - sign * f->t < -(blur + blur)) from = features[from].next;
    uint end = from;
    for (; end != OX_NONE; end = features[end].next)
      if (((features[end].flags ^ f->flags) & OX_FEATURE_LEAVES) != 0u &&
          sign * features[end].t - sign * f->t >= -(crossings[i].blur + crossings[end].blur))
        break;
    f->partner = end != OX_NONE ? end : ox_find_end_inside(scene, features, slots, f);
  }
}

// Partners of all crossings of an edge, from the head of their chain on. Returns its new head.
static inline uint ox_find_partners(const ox_scene* scene, __global ox_feature* features,
                                    __global const uint* slots,
                                    __global const ox_edge_crossing* crossings, uint head) {
  if (features[head].next == OX_NONE) {
    features[head].partner = ox_find_end_inside(scene, features, slots, features + head);
    return head;
  }
  for (float sign = 1.0f; sign > -2.0f; sign -= 2.0f) {
    head = ox_sort_chain(features, head, sign);
    ox_pair_crossings(scene, features, slots, crossings, head, sign);
  }
  return head;
}

#endif
