// SPDX-License-Identifier: BSD-3-Clause
// Records of which each field lies for itself, so that sixteen are looked at at a time: field f
// begins f times `room` words behind the first. Device only.
//
// The last lanes that are loaded may lie beyond the last record: in the next field, or in what is
// left free at the end of the buffer.
#ifndef ODE_EXT_KERNELS_CONTACTS_FIELDS_H
#define ODE_EXT_KERNELS_CONTACTS_FIELDS_H

#include "lib/lanes.h"

typedef struct {
  __global float* words;
  uint room;  // for so many records
} ox_fields;

static inline __global float* ox_floats_of(const ox_fields* fields, uint field) {
  return fields->words + (ulong)field * fields->room;
}

static inline __global uint* ox_words_of(const ox_fields* fields, uint field) {
  return (__global uint*)ox_floats_of(fields, field);
}

static inline float3 ox_vector_of(const ox_fields* fields, uint field, uint i) {
  return (float3)(ox_floats_of(fields, field)[i], ox_floats_of(fields, field + 1u)[i],
                  ox_floats_of(fields, field + 2u)[i]);
}

static inline void ox_set_vector(const ox_fields* fields, uint field, uint i, float3 v) {
  ox_floats_of(fields, field)[i] = v.x;
  ox_floats_of(fields, field + 1u)[i] = v.y;
  ox_floats_of(fields, field + 2u)[i] = v.z;
}

// A block of them.
#define OX_LOAD_FLOATS(fields, field, block) ox_load_floats(block, ox_floats_of(fields, field))
#define OX_LOAD_WORDS(fields, field, block) ox_load_ints(block, ox_words_of(fields, field))

// Stores a block where there are `count` in all: what is behind the last stays.
#if defined(OX_LANES_ARE_GROUP)
#define OX_STORE_BLOCK(type, keep, values, block, count, to)               \
  do {                                                                     \
    if (OX_PLACE(block) < (count)) (to)[OX_PLACE(block)] = (type)(values); \
  } while (0)
#else
#define OX_STORE_BLOCK(type, keep, values, block, count, to)        \
  do {                                                              \
    type of[OX_VECTOR_WIDTH];                                       \
    keep(values, 0, of);                                            \
    const uint begin = OX_VECTOR_WIDTH * (block);                   \
    const uint present = min((count)-begin, (uint)OX_VECTOR_WIDTH); \
    for (uint k = 0u; k < present; ++k) (to)[begin + k] = of[k];    \
  } while (0)
#endif
#define OX_STORE_FLOATS(fields, field, block, count, values) \
  OX_STORE_BLOCK(float, ox_store, values, block, count, ox_floats_of(fields, field))
#define OX_STORE_WORDS(fields, field, block, count, values) \
  OX_STORE_BLOCK(uint, ox_store_ints, values, block, count, ox_words_of(fields, field))

// Of a block the products with a vector, of three fields from one on.
static inline void ox_dot_fields(const ox_fields* fields, uint field, uint block, float3 v,
                                 ox_floats* products) {
  *products = OX_LOAD_FLOATS(fields, field, block) * v.x +
              OX_LOAD_FLOATS(fields, field + 1u, block) * v.y +
              OX_LOAD_FLOATS(fields, field + 2u, block) * v.z;
}

#endif
