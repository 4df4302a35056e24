// SPDX-License-Identifier: BSD-3-Clause
// The candidates of a pair in the order of their depths, so that what is looked for among all of
// them is found without a look at all. Device only.
#ifndef ODE_EXT_KERNELS_SHARED_CANDIDATE_ORDER_H
#define ODE_EXT_KERNELS_SHARED_CANDIDATE_ORDER_H

#include "shared/contradiction.h"

static inline bool ox_is_ordered_before(__global const ox_candidate* candidates, uint i, uint j) {
  if (ox_deeper(candidates + i, candidates + j)) return true;
  return i < j && !ox_deeper(candidates + j, candidates + i);
}

static inline void ox_sift_candidates(__global ox_candidate* candidates, uint root, uint end) {
  const uint sifted = candidates[root].ordered;
  for (;;) {
    uint child = 2u * root + 1u;
    if (child >= end) break;
    if (child + 1u < end &&
        ox_is_ordered_before(candidates, candidates[child].ordered, candidates[child + 1u].ordered))
      ++child;
    if (!ox_is_ordered_before(candidates, sifted, candidates[child].ordered)) break;
    candidates[root].ordered = candidates[child].ordered;
    root = child;
  }
  candidates[root].ordered = sifted;
}

// Makes candidates[k].ordered the k-th of those of a kind, the deepest first; returns how many they
// are. Heap sort, as of the crossings.
static inline uint ox_order_by_depth(__global ox_candidate* candidates, uint count, uint kind) {
  uint ordered = 0u;
  for (uint i = 0u; i < count; ++i)
    if (ox_kind(candidates + i) == kind) candidates[ordered++].ordered = i;
  for (uint i = ordered / 2u; i-- > 0u;) ox_sift_candidates(candidates, i, ordered);
  for (uint end = ordered; end > 1u; --end) {
    const uint swap = candidates[0].ordered;
    candidates[0].ordered = candidates[end - 1u].ordered;
    candidates[end - 1u].ordered = swap;
    ox_sift_candidates(candidates, 0u, end - 1u);
  }
  return ordered;
}

#endif
