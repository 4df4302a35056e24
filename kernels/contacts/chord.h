// SPDX-License-Identifier: BSD-3-Clause
// Chords: the stretches of an edge that are inside the other mesh. Device only.
//
// A crossing by which the edge enters and that by which it leaves again are the two ends of one,
// paired as brackets are: where parts of the other mesh overlap the outermost two bound the stretch
// that is inside of any, and those between are nested in it. What is open need not be left as often
// as it is entered.
#ifndef ODE_EXT_KERNELS_CONTACTS_CHORD_H
#define ODE_EXT_KERNELS_CONTACTS_CHORD_H

#include "contacts/feature_table.h"

static inline bool ox_enters(__global const ox_feature* f) {
  return (f->flags & OX_FEATURE_LEAVES) == 0u;
}

// From the first vertex of the edge on. At one place it enters before it leaves: out of one part
// into the next it is inside all along.
static inline bool ox_comes_before(__global const ox_feature* a, __global const ox_feature* b) {
  if (a->t != b->t) return a->t < b->t;
  return ox_enters(a) != ox_enters(b) ? ox_enters(a) : a->triangle < b->triangle;
}

// Two chains in order, as one.
static inline uint ox_merge_chains(__global ox_feature* features, uint a, uint b) {
  uint head = OX_NONE;
  uint last = OX_NONE;
  while (a != OX_NONE && b != OX_NONE) {
    const bool takes_b = ox_comes_before(features + b, features + a);
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
static inline uint ox_sort_chain(__global ox_feature* features, uint head) {
  if (features[head].next == OX_NONE) return head;
  uint sorted[32];  // of 2^i each; OX_NONE: there is none
  for (uint i = 0u; i < 32u; ++i) sorted[i] = OX_NONE;
  while (head != OX_NONE) {
    uint chain = head;
    head = features[head].next;
    features[chain].next = OX_NONE;
    uint i = 0u;
    for (; i < 31u && sorted[i] != OX_NONE; ++i) {
      chain = ox_merge_chains(features, sorted[i], chain);
      sorted[i] = OX_NONE;
    }
    sorted[i] = chain;
  }
  uint all = OX_NONE;
  for (uint i = 0u; i < 32u; ++i) all = ox_merge_chains(features, sorted[i], all);
  return all;
}

// The vertex at the end of an edge that is on the inner side of a crossing, if it is inside.
static inline uint ox_find_end_inside(const ox_scene* scene, __global const ox_feature* f) {
  const bool leaves = (f->flags & OX_FEATURE_LEAVES) != 0u;
  const uint vertex = scene->edges[f->source].vertex[leaves ? 0u : 1u];
  const uint entry = ox_find_feature(scene, ox_inside_key(f->pair, ox_side_of(f->flags), vertex));
  return entry == OX_NONE ? OX_NONE : entry >> 2;
}

// The first crossing after one by which an edge leaves by which it enters, if rounding may have
// changed their order: it enters first then, and what lies side by side is one.
static inline uint ox_find_entry(const ox_scene* scene, uint leave) {
  for (uint n = scene->features[leave].next; n != OX_NONE; n = scene->features[n].next) {
    if (scene->features[n].t - scene->features[leave].t >
        scene->crossings[leave].blur + scene->crossings[n].blur)
      break;
    if (ox_enters(scene->features + n) && scene->features[n].partner == OX_NONE) return n;
  }
  return OX_NONE;
}

// Partners of all crossings of an edge, from the head of their chain on, and which are nested; by
// one work-item, while others may read other bits of the flags. Returns its new head.
static inline uint ox_find_partners(const ox_scene* scene, uint head) {
  head = ox_sort_chain(scene->features, head);
  uint left = OX_NONE;  // the last by which it left without having entered
  // The last by which it entered and has not left yet; each has the one before as its partner.
  uint open = OX_NONE;
  for (uint i = head; i != OX_NONE; i = scene->features[i].next) {
    __global ox_feature* f = scene->features + i;
    if (f->partner != OX_NONE) continue;  // of a leave before it
    if (ox_enters(f)) {
      f->partner = open;
      open = i;
      continue;
    }
    const uint entry = ox_find_entry(scene, i);
    f->partner = entry != OX_NONE ? entry : open;
    if (f->partner == OX_NONE) {
      f->partner = ox_find_end_inside(scene, f);
      left = i;
      continue;
    }
    if (entry == OX_NONE) open = scene->features[open].partner;
    scene->features[f->partner].partner = i;
    if (open == OX_NONE) continue;
    scene->features[f->partner].flags |= OX_FEATURE_NESTED;
    f->flags |= OX_FEATURE_NESTED;
  }
  while (open != OX_NONE) {
    __global ox_feature* f = scene->features + open;
    open = f->partner;
    if (open != OX_NONE) f->flags |= OX_FEATURE_NESTED;
    f->partner = ox_find_end_inside(scene, f);
  }
  // All before is in the chord that begins at the edge's first vertex and ends there.
  for (uint i = left == OX_NONE ? OX_NONE : head; i != left; i = scene->features[i].next)
    scene->features[i].flags |= OX_FEATURE_NESTED;
  return head;
}

// Makes the next of each crossing of an edge, from the head of their chain on, that by which the
// edge enters again after it has left, or by which it left before it enters.
static inline void ox_link_outside(__global ox_feature* features, uint head) {
  uint left = OX_NONE;     // the last by which it left
  uint outside = OX_NONE;  // the first by which it left since it last entered
  for (uint i = head; i != OX_NONE;) {
    const uint next = features[i].next;
    if (!ox_enters(features + i)) {
      left = i;
      if (outside == OX_NONE) outside = i;
    }
    while (outside != OX_NONE && (ox_enters(features + i) || next == OX_NONE)) {
      const uint after = outside == left ? OX_NONE : features[outside].next;
      features[outside].next = ox_enters(features + i) ? i : OX_NONE;
      outside = after;
    }
    if (ox_enters(features + i)) features[i].next = left;
    i = next;
  }
}

#endif
