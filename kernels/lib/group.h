// SPDX-License-Identifier: BSD-3-Clause
// A work-group that goes through one item of work together (OX_LANES_ARE_GROUP): OX_LANES
// work-items, so that all of them are of one warp, with the instructions of NVIDIA's devices by
// which a warp hands values on (PTX ISA, vote.sync and shfl.sync); OpenCL C 1.2 has none. The host
// knows where they exist (collide/options.h) and tries them out (opencl/self_test.cpp). Elsewhere
// each work-item goes through an item alone, and here is what that comes to. Device only.
//
// All work-items of a group take the same way through the code and meet at each of these functions,
// but for what is dealt out to them by OX_ITEM and OX_ITEMS, or done by the first alone. From one
// meeting to the next one may be ahead of another. What they write is the same in each, so it is no
// matter which comes last; what others may read before or overwrite after is written between two
// ox_settle(). None of this may stand where a macro or an operator evaluates it for some of them.
#ifndef ODE_EXT_KERNELS_LIB_GROUP_H
#define ODE_EXT_KERNELS_LIB_GROUP_H

#include "abi/types.h"

#if defined(OX_LANES_ARE_GROUP)

static inline uint ox_group_item(void) { return (uint)get_local_id(0); }

#if defined(OX_EMULATED_GROUP)  // on a processor: tests/groups/group_emulation.cpp
uint ox_emulated_of_item(uint value, uint item);
uint ox_emulated_bits(uint holds);
#endif

// What one of the work-items has, for each of them.
static inline uint ox_of_item(uint value, uint item) {
#if defined(OX_EMULATED_GROUP)
  return ox_emulated_of_item(value, item);
#else
  uint there;
  __asm__ volatile("shfl.sync.idx.b32 %0, %1, %2, 31, 0xffff;"
                   : "=r"(there)
                   : "r"(value), "r"(item));
  return there;
#endif
}

// What the one so many after it has; that of the last where there is none.
static inline uint ox_from_above(uint value, uint more) {
  return ox_of_item(value, min(ox_group_item() + more, OX_LANES - 1u));
}

// A bit for each for which something holds.
static inline uint ox_group_bits(bool holds) {
#if defined(OX_EMULATED_GROUP)
  return ox_emulated_bits(holds ? 1u : 0u);
#else
  uint bits;
  __asm__ volatile(
      "{\n\t.reg .pred p;\n\tsetp.ne.u32 p, %1, 0;\n\t"
      "vote.sync.ballot.b32 %0, p, 0xffff;\n\t}"
      : "=r"(bits)
      : "r"(holds ? 1u : 0u));
  return bits;
#endif
}

static inline bool ox_is_first_item(void) { return ox_group_item() == 0u; }
// Of a bit for each lane those that a work-item sees to.
static inline uint ox_own_bits(uint bits) { return bits & 1u << ox_group_item(); }
static inline bool ox_any_item(bool holds) { return ox_group_bits(holds) != 0u; }
// All have read and written what comes before.
static inline void ox_settle(void) { barrier(CLK_GLOBAL_MEM_FENCE); }
#define OX_ITEM ox_group_item()
#define OX_ITEMS OX_LANES
#define OX_FIRST_WORK ((uint)get_group_id(0))
#define OX_WORK_STRIDE ((uint)get_num_groups(0))

#else

static inline uint ox_of_item(uint value, uint item) {
  (void)item;
  return value;
}
static inline uint ox_group_bits(bool holds) { return holds ? 1u : 0u; }
static inline bool ox_is_first_item(void) { return true; }
static inline uint ox_own_bits(uint bits) { return bits; }
static inline bool ox_any_item(bool holds) { return holds; }
static inline void ox_settle(void) {}
#define OX_ITEM 0u
#define OX_ITEMS 1u
#define OX_FIRST_WORK ((uint)get_global_id(0))
#define OX_WORK_STRIDE ((uint)get_global_size(0))

#endif

#endif
