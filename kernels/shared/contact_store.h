// SPDX-License-Identifier: BSD-3-Clause
// Contacts, as they are handed out. Device only.
#ifdef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_CONTACT_STORE_H
#define ODE_EXT_KERNELS_SHARED_CONTACT_STORE_H

#include "shared/append.h"

#define OX_MAX_CONTACTS 64u

static inline void ox_store_contact(__global const ox_candidate* candidate,
                                    __global ox_contact* contact) {
  contact->side_kind = candidate->side_kind;
  contact->vertex = candidate->vertex;
  contact->triangle = candidate->triangle;
  contact->depth = candidate->depth;
  vstore3(vload3(0, candidate->position), 0, contact->position);
  vstore3(vload3(0, candidate->normal), 0, contact->normal);
}

// Room for `count` contacts of pair p; less where the list is full.
static inline uint ox_place_contacts(const ox_scene* scene, uint count, __global ox_range* range) {
  const uint first = ox_take_room(scene, OX_LIST_CONTACTS, count);
  const uint capacity = scene->lists[OX_LIST_CONTACTS].capacity;
  range->first = first;
  range->count = min(count, first < capacity ? capacity - first : 0u);
  return range->count;
}

#endif
#endif
