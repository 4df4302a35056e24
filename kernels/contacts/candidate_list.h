// SPDX-License-Identifier: BSD-3-Clause
// The candidates of a pair, of which some become contacts: types.h says how they lie. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_CANDIDATE_LIST_H
#define ODE_EXT_KERNELS_CONTACTS_CANDIDATE_LIST_H

#include "abi/contacts.h"
#include "contacts/fields.h"
#include "lib/append.h"

#define OX_MAX_CONTACTS 64u

static inline ox_fields ox_candidates_of(const ox_scene* scene, uint pair) {
  const ulong first = (ulong)OX_CANDIDATES_PER_FEATURE * scene->found[pair].first;
  const ox_fields list = {scene->candidates + OX_CANDIDATE_WORDS * first,
                          OX_CANDIDATES_PER_FEATURE * scene->found[pair].features};
  return list;
}

// Its position in the frame of the mesh whose base is its origin: far out in the other it would be
// rounded.
static inline void ox_store_contact(const ox_fields* list, uint i, __global const ox_pair* pair,
                                    __global ox_contact* contact) {
  const float3 position = ox_vector_of(list, OX_CANDIDATE_POSITION, i);
  const float3 base = ox_base(pair, 1u);
  const bool is_in_a = base.x != 0.0f || base.y != 0.0f || base.z != 0.0f;
  contact->side_kind = ox_words_of(list, OX_CANDIDATE_SIDE_KIND)[i] | (is_in_a ? OX_HIT_IN_A : 0u);
  contact->vertex = ox_words_of(list, OX_CANDIDATE_VERTEX)[i];
  contact->triangle = ox_words_of(list, OX_CANDIDATE_TRIANGLE)[i];
  contact->depth = ox_floats_of(list, OX_CANDIDATE_DEPTH)[i];
  vstore3(is_in_a ? ox_transform_from_base(pair, 1u, position) : position, 0, contact->position);
  vstore3(ox_vector_of(list, OX_CANDIDATE_NORMAL, i), 0, contact->normal);
  for (uint k = 0u; k < 2u; ++k)
    contact->feature[k] = ox_words_of(list, OX_CANDIDATE_FEATURE + k)[i];
  contact->region = ox_words_of(list, OX_CANDIDATE_REGION)[i];
}

// Room for `count` contacts of a pair; less where the list is full.
static inline uint ox_place_contacts(const ox_scene* scene, uint count, __global ox_range* range) {
  const uint first = ox_fetch_add_shared(scene->contact_count, count);
  if (first >= OX_MOST_COUNTED) ox_fetch_add_shared(scene->contact_count, 0u - count);
  const uint capacity = scene->lists[OX_LIST_CONTACTS].capacity;
  range->first = first;
  range->count = min(count, first < capacity ? capacity - first : 0u);
  return range->count;
}

#endif
