// SPDX-License-Identifier: BSD-3-Clause
// The faces that are planes for each region, one of each facet: a hash table with open addressing
// for each, filled by many work-items at a time. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_FACE_TABLE_H
#define ODE_EXT_KERNELS_CONTACTS_FACE_TABLE_H

#include "contacts/feature.h"

static inline ox_face ox_no_face(void) {
  const ox_face face = {OX_NONE, 0u, OX_NONE, OX_NONE};
  return face;
}

// Puts a face in, unless its facet is there, and says where it is among those of the region. Of a
// facet the first triangle is kept.
static inline uint ox_add_face(const ox_scene* scene, __global const ox_region* region, uint owner,
                               uint side, uint triangle) {
  const uint key = ox_facet_of(scene, triangle) << 1 | side;
  const uint count = OX_FACES_PER_FEATURE * region->count;
  __global volatile ox_face* faces = scene->faces + OX_FACES_PER_FEATURE * region->first;
  for (uint place = mul_hi(key * 0x9e3779b1u, count);;  // multiplicative (Knuth)
       place = place + 1u < count ? place + 1u : 0u) {
    __global volatile ox_face* face = faces + place;
    uint there = face->key;
    if (there == OX_NONE) there = ox_compare_exchange(scene, &face->key, OX_NONE, key);
    if (there != OX_NONE && there != key) continue;
    if (face->triangle > triangle) ox_fetch_min(scene, &face->triangle, triangle);
    if ((face->owner & owner) != owner) ox_fetch_or(scene, &face->owner, owner);
    return place;
  }
}

#endif
