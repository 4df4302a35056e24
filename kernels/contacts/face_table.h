// SPDX-License-Identifier: BSD-3-Clause
// The faces that are planes for each region, one of each facet: a hash table with open addressing.
// Device only.
//
// An entry is feature << 2 | which of its faces.
#ifdef OX_PLANES
#ifndef ODE_EXT_KERNELS_CONTACTS_FACE_TABLE_H
#define ODE_EXT_KERNELS_CONTACTS_FACE_TABLE_H

#include "contacts/feature.h"

#define OX_FACE_OPPOSITE 0u  // of the other mesh: that is crossed, or that the vertex leaves by
#define OX_FACE_FIRST 1u     // the first, or
#define OX_FACE_SECOND 2u    // the second at the edge

// A face is of one of the meshes of the pair of its region.
typedef struct {
  uint region, side, facet, triangle;
} ox_face_key;

static inline ox_face_key ox_face_key_of(const ox_scene* scene, __global const ox_feature* features,
                                         uint entry) {
  __global const ox_feature* f = features + (entry >> 2);
  const uint which = entry & 3u;
  ox_face_key key;
  key.region = f->region;
  key.side = which == OX_FACE_OPPOSITE ? 1u - ox_side_of(f->flags) : ox_side_of(f->flags);
  key.triangle = which == OX_FACE_OPPOSITE ? f->triangle : f->at[which - OX_FACE_FIRST];
  key.facet = scene->facets[key.triangle];
  return key;
}

static inline uint ox_hash_of_face(ox_face_key key) {
  uint h = key.region * 2u + key.side;  // as ox_hash_of
  h = (h ^ h >> 15) * 0x9e3779b1u + key.facet;
  h = (h ^ h >> 15) * 0x85ebca6bu;
  return h ^ h >> 16;
}

static inline bool ox_is_face(ox_face_key a, ox_face_key b) {
  return a.region == b.region && a.side == b.side && a.facet == b.facet;
}

// Puts a face in, unless its facet is there. Of a facet the first triangle is kept. Each pair has a
// stretch of the table.
static inline void ox_add_face(const ox_scene* scene, __global const ox_feature* features,
                               __global volatile ox_face* faces, uint entry) {
  const ox_face_key key = ox_face_key_of(scene, features, entry);
  __global const ox_feature* f = features + (entry >> 2);
  const uint first = OX_FACES_PER_FEATURE * scene->found[f->pair].first;
  const uint count = OX_FACES_PER_FEATURE * scene->found[f->pair].features;
  for (uint slot = mul_hi(ox_hash_of_face(key), count);;
       slot = slot + 1u < count ? slot + 1u : 0u) {
    __global volatile ox_face* face = faces + first + slot;
    uint there = face->entry;
    if (there == OX_NONE) there = atomic_cmpxchg(&face->entry, OX_NONE, entry);
    if (there != OX_NONE && !ox_is_face(ox_face_key_of(scene, features, there), key)) continue;
    if (face->triangle > key.triangle) atomic_min(&face->triangle, key.triangle);
    if (!ox_is_vertex(f->flags) && face->crossed == 0u) face->crossed = 1u;
    return;
  }
}

// The plane of a face that is in, among those of its region.
static inline uint ox_plane_of_entry(const ox_scene* scene, __global const ox_feature* features,
                                     __global const ox_face* faces, uint entry) {
  const ox_face_key key = ox_face_key_of(scene, features, entry);
  const uint pair = features[entry >> 2].pair;
  const uint first = OX_FACES_PER_FEATURE * scene->found[pair].first;
  const uint count = OX_FACES_PER_FEATURE * scene->found[pair].features;
  uint slot = mul_hi(ox_hash_of_face(key), count);
  while (!ox_is_face(ox_face_key_of(scene, features, faces[first + slot].entry), key))
    slot = slot + 1u < count ? slot + 1u : 0u;
  return faces[first + slot].plane;
}

#endif
#endif
