// SPDX-License-Identifier: BSD-3-Clause
// The lanes of a meshlet, OX_LANES of them, taken OX_VECTOR_WIDTH at a time: as vectors where the
// device has such, one by one where it has not. Lane by lane the same operations in the same order,
// so the width changes no bit. The host chooses it (opencl/program.h). Device only.
//
// Of a comparison only say whether it is 0: true is -1 in a vector and 1 alone.
//
// OX_LANES_ARE_GROUP: a vector is a work-group (lib/group.h), for kernels of which one work-item
// would have to go through too much alone. Each of its work-items has a lane of what is ox_floats
// or ox_ints, and all else is the same in all of them: they take the same way.
#ifndef ODE_EXT_KERNELS_LIB_LANES_H
#define ODE_EXT_KERNELS_LIB_LANES_H

#include "lib/group.h"
#include "lib/transform.h"

#ifndef OX_VECTOR_WIDTH
#define OX_VECTOR_WIDTH 8
#endif

#define OX_BLOCKS (OX_LANES / OX_VECTOR_WIDTH)

// The blocks that a work-item takes, from `first` up to `end`: on a processor all of them; on a
// GPU, where a lane is a work-item, one. Masks then have bits of these alone.
typedef struct {
  uint first, end;
} ox_block_range;
#define OX_ALL_BLOCKS ((ox_block_range){0u, OX_BLOCKS})

// Values go to functions by address: by value their convention changes with what the CPU has.
#if defined(OX_LANES_ARE_GROUP)
typedef float ox_floats;
typedef int ox_ints;
#elif OX_VECTOR_WIDTH == 16
typedef float16 ox_floats;
typedef int16 ox_ints;
#elif OX_VECTOR_WIDTH == 8
typedef float8 ox_floats;
typedef int8 ox_ints;
#elif OX_VECTOR_WIDTH == 4
typedef float4 ox_floats;
typedef int4 ox_ints;
#elif OX_VECTOR_WIDTH == 1
typedef float ox_floats;
typedef int ox_ints;
#else
#error "OX_VECTOR_WIDTH is 1, 4, 8 or 16"
#endif

#if defined(OX_LANES_ARE_GROUP)
#define OX_PLACE(block) (OX_VECTOR_WIDTH * (block) + ox_group_item())
#else
#define OX_PLACE(block) (block)
#endif

// A block of the lanes of a record, which lie on a boundary of all of them: buffers do, and their
// records' lanes come first or after as many bytes (abi/types.h).
#define ox_load(block, p) (((__global const ox_floats*)(p))[OX_PLACE(block)])

// The same of what need not lie there, in global memory and in private. Not vload16, which PoCL
// takes to pieces of eight bytes.
typedef ox_floats ox_floats_anywhere __attribute__((aligned(4)));
typedef ox_ints ox_ints_anywhere __attribute__((aligned(4)));
#define ox_load_floats(block, p) (((__global const ox_floats_anywhere*)(p))[OX_PLACE(block)])
#define ox_load_ints(block, p) (((__global const ox_ints_anywhere*)(p))[OX_PLACE(block)])
#define ox_load_own(block, p) (((const ox_floats_anywhere*)(p))[block])
#define ox_load_own_ints(block, p) (((const ox_ints_anywhere*)(p))[block])
#define ox_store(v, block, p) (((ox_floats_anywhere*)(p))[block] = (v))
#define ox_store_ints(v, block, p) (((ox_ints_anywhere*)(p))[block] = (v))

// Not fmin and fmax, which mind what is no number and take PoCL several times as long: where one is
// none these give b.
#define OX_LESSER(a, b) ((a) < (b) ? (a) : (b))
#define OX_GREATER(a, b) ((a) > (b) ? (a) : (b))

// All lanes by one operator: `op(a, b)`.
#define OX_OR(a, b) ((a) | (b))
#define OX_AND(a, b) ((a) & (b))
#define OX_FOLD4(v, op) op(op((v).x, (v).y), op((v).z, (v).w))
#if defined(OX_LANES_ARE_GROUP)  // ox_least_of and ox_greatest_of below
#elif OX_VECTOR_WIDTH == 16
#define OX_FOLD(v, op) OX_FOLD4(op(op((v).s0123, (v).s4567), op((v).s89ab, (v).scdef)), op)
#elif OX_VECTOR_WIDTH == 8
#define OX_FOLD(v, op) OX_FOLD4(op((v).lo, (v).hi), op)
#elif OX_VECTOR_WIDTH == 4
#define OX_FOLD(v, op) OX_FOLD4(v, op)
#else
#define OX_FOLD(v, op) (v)
#endif

// The least bit that is set, of one that has any.
static inline uint ox_lowest(uint bits) { return 31u - clz(bits & (~bits + 1u)); }

// A bit for each lane where a comparison holds.
#if defined(OX_LANES_ARE_GROUP)  // ox_mask_of below
#elif OX_VECTOR_WIDTH == 16
#define OX_LANE_BITS \
  (int16)(1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16384, 32768)
#elif OX_VECTOR_WIDTH == 8
#define OX_LANE_BITS (int8)(1, 2, 4, 8, 16, 32, 64, 128)
#elif OX_VECTOR_WIDTH == 4
#define OX_LANE_BITS (int4)(1, 2, 4, 8)
#else
#define OX_LANE_BITS 1
#endif

#if defined(OX_LANES_ARE_GROUP)
#define OX_LANE_NUMBERS ((int)ox_group_item())
#elif OX_VECTOR_WIDTH == 16
#define OX_LANE_NUMBERS (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#elif OX_VECTOR_WIDTH == 8
#define OX_LANE_NUMBERS (int8)(0, 1, 2, 3, 4, 5, 6, 7)
#elif OX_VECTOR_WIDTH == 4
#define OX_LANE_NUMBERS (int4)(0, 1, 2, 3)
#else
#define OX_LANE_NUMBERS 0
#endif

#define OX_ALL_LANES ((1u << OX_VECTOR_WIDTH) - 1u)

// Where x86 has an instruction for it, that: the compiler finds none of these by itself. The host
// can leave them out (OX_NO_BUILTINS); they give the same.
#if !defined(OX_NO_BUILTINS) && OX_VECTOR_WIDTH == 16 && defined(__AVX512F__)
#define OX_HAS_AVX512
typedef int ox_native_ints __attribute__((__vector_size__(64)));
typedef float ox_native_floats __attribute__((__vector_size__(64)));
#elif !defined(OX_NO_BUILTINS) && OX_VECTOR_WIDTH == 8 && defined(__AVX__)
#define OX_HAS_AVX
typedef float ox_native_floats __attribute__((__vector_size__(32)));
#if defined(__AVX2__)
#define OX_HAS_AVX2
typedef int ox_native_ints __attribute__((__vector_size__(32)));
#endif
#endif

static inline uint ox_mask_of(const ox_ints* v) {
#if defined(OX_LANES_ARE_GROUP)
  return ox_group_bits(*v != 0);
#elif defined(OX_HAS_AVX512)
  const int is_not_equal = 4;
  return (ushort)__builtin_ia32_cmpd512_mask((ox_native_ints)*v, (ox_native_ints)(ox_ints)(0),
                                             is_not_equal, (ushort)0xffffu);
#elif defined(OX_HAS_AVX)
  return (uint)__builtin_ia32_movmskps256((ox_native_floats)*v);
#else
  const ox_ints bits = *v & OX_LANE_BITS;
  return as_uint(OX_FOLD(bits, OX_OR));
#endif
}

// The lanes of a vector, to be asked for one at a time.
typedef struct {
#if defined(OX_LANES_ARE_GROUP)
  float own;
#else
  float of[OX_VECTOR_WIDTH];
#endif
} ox_lane_floats;

static inline void ox_keep_lanes(const ox_floats* v, ox_lane_floats* lanes) {
#if defined(OX_LANES_ARE_GROUP)
  lanes->own = *v;
#else
  ox_store(*v, 0, lanes->of);
#endif
}

static inline void ox_kept_lanes(const ox_lane_floats* lanes, ox_floats* v) {
#if defined(OX_LANES_ARE_GROUP)
  *v = lanes->own;
#else
  *v = ox_load_own(0, lanes->of);
#endif
}

static inline float ox_lane(const ox_lane_floats* lanes, uint k) {
#if defined(OX_LANES_ARE_GROUP)
  return as_float(ox_of_item(as_uint(lanes->own), k));
#else
  return lanes->of[k];
#endif
}

#if !defined(OX_LANES_ARE_GROUP)
// In each lane what `from` has in the lane that it names, of all OX_LANES.
static inline void ox_pick_lanes(const float* from, const ox_ints* lanes, ox_floats* picked) {
#if defined(OX_HAS_AVX512)
  const ox_native_floats all = (ox_native_floats)ox_load_own(0, from);
  *picked = __builtin_astype(__builtin_ia32_permvarsf512(all, (ox_native_ints)*lanes), ox_floats);
#elif defined(OX_HAS_AVX2)  // of each half, by the lowest three bits
  const ox_native_ints lane = (ox_native_ints)*lanes;
  const ox_native_floats low =
      __builtin_ia32_permvarsf256((ox_native_floats)ox_load_own(0, from), lane);
  const ox_native_floats high =
      __builtin_ia32_permvarsf256((ox_native_floats)ox_load_own(1, from), lane);
  const ox_ints is_high = (*lanes & 8) != 0;
  *picked = is_high ? __builtin_astype(high, ox_floats) : __builtin_astype(low, ox_floats);
#else
  int lane[OX_VECTOR_WIDTH];
  float there[OX_VECTOR_WIDTH];
  ox_store_ints(*lanes, 0, lane);
  for (uint k = 0u; k < OX_VECTOR_WIDTH; ++k) there[k] = from[lane[k]];
  *picked = ox_load_own(0, there);
#endif
}

static inline void ox_pick_ints(const int* from, const ox_ints* lanes, ox_ints* picked) {
#if defined(OX_HAS_AVX512)
  const ox_native_ints all = (ox_native_ints)ox_load_own_ints(0, from);
  *picked = __builtin_astype(__builtin_ia32_permvarsi512(all, (ox_native_ints)*lanes), ox_ints);
#elif defined(OX_HAS_AVX2)  // which moves bits, whatever they stand for
  ox_floats there;
  ox_pick_lanes((const float*)from, lanes, &there);
  *picked = __builtin_astype(there, ox_ints);
#else
  int lane[OX_VECTOR_WIDTH];
  int there[OX_VECTOR_WIDTH];
  ox_store_ints(*lanes, 0, lane);
  for (uint k = 0u; k < OX_VECTOR_WIDTH; ++k) there[k] = from[lane[k]];
  *picked = ox_load_own_ints(0, there);
#endif
}
#endif

// A bit for each lane of a block that is one of so many in all.
static inline uint ox_present_lanes(uint count, uint block) {
  const uint before = OX_VECTOR_WIDTH * block;
  if (count <= before) return 0u;
  return count - before < OX_VECTOR_WIDTH ? (1u << (count - before)) - 1u : OX_ALL_LANES;
}

// So many blocks of a long list are looked at at once: a work-group of a GPU waits for what it has
// loaded, and for the loop itself, with the next one's in flight.
#if defined(OX_LANES_ARE_GROUP)
#define OX_BLOCKS_AT_ONCE 4u
#else
#define OX_BLOCKS_AT_ONCE 1u
#endif

#if defined(OX_LANES_ARE_GROUP)
// In the order of OX_FOLD.
#define OX_FOLD_GROUP(name, op)                                        \
  static inline float name(const ox_floats* v) {                       \
    float all = *v;                                                    \
    for (uint i = 0u; i < 4u; ++i) {                                   \
      const uint more = (0x2184u >> 4u * i) & 15u;                     \
      const float there = as_float(ox_from_above(as_uint(all), more)); \
      all = op(all, there);                                            \
    }                                                                  \
    return as_float(ox_of_item(as_uint(all), 0u));                     \
  }
OX_FOLD_GROUP(ox_least_of, OX_LESSER)
OX_FOLD_GROUP(ox_greatest_of, OX_GREATER)
// Of what each work-item has.
static inline float ox_least_of_items(float own) { return ox_least_of(&own); }
#else
static inline float ox_least_of_items(float own) { return own; }
static inline int ox_and_of(const ox_ints* v) { return OX_FOLD(*v, OX_AND); }
static inline float ox_least_of(const ox_floats* v) { return OX_FOLD(*v, OX_LESSER); }
static inline float ox_greatest_of(const ox_floats* v) { return OX_FOLD(*v, OX_GREATER); }
#endif

#endif
