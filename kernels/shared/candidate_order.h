// SPDX-License-Identifier: BSD-3-Clause
// The candidates of a pair in the order of their depths, so that what is looked for among all of
// them is found without a look at all. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_CANDIDATE_ORDER_H
#define ODE_EXT_KERNELS_SHARED_CANDIDATE_ORDER_H

#include "shared/contradiction.h"

// Points of one place and one pair of triangles have the same key. They were added in an order that
// does not depend on that of the hits, so their indices decide.
static inline bool ox_is_keyed_before(__global const ox_candidate* candidates, uint i, uint j) {
  if (ox_key_less(candidates + i, candidates + j)) return true;
  return i < j && !ox_key_less(candidates + j, candidates + i);
}

static inline bool ox_is_ordered_before(__global const ox_candidate* candidates, uint i, uint j) {
  return candidates[i].depth != candidates[j].depth ? candidates[i].depth > candidates[j].depth
                                                    : ox_is_keyed_before(candidates, i, j);
}

// What is sorted: a candidate, and its depth beside it, so that few have to be looked up.
typedef struct {
  uint candidate;
  float depth;
} ox_ordered;

static inline ox_ordered ox_ordered_at(__global const ox_candidate* candidates, uint k) {
  const ox_ordered at = {candidates[k].ordered, candidates[k].distance2};
  return at;
}

static inline void ox_put_ordered(__global ox_candidate* candidates, uint k, ox_ordered at) {
  candidates[k].ordered = at.candidate;
  candidates[k].distance2 = at.depth;
}

static inline bool ox_precedes(__global const ox_candidate* candidates, ox_ordered a,
                               ox_ordered b) {
  return a.depth != b.depth ? a.depth > b.depth
                            : ox_is_ordered_before(candidates, a.candidate, b.candidate);
}

static inline void ox_sift_candidates(__global ox_candidate* candidates, uint root, uint end,
                                      ox_ordered sifted) {
  for (;;) {
    uint child = 2u * root + 1u;
    if (child >= end) break;
    ox_ordered last = ox_ordered_at(candidates, child);
    if (child + 1u < end) {
      const ox_ordered other = ox_ordered_at(candidates, child + 1u);
      if (ox_precedes(candidates, last, other)) {
        last = other;
        ++child;
      }
    }
    if (!ox_precedes(candidates, sifted, last)) break;
    ox_put_ordered(candidates, root, last);
    root = child;
  }
  ox_put_ordered(candidates, root, sifted);
}

// Makes candidates[k].ordered the k-th of those of a kind, the deepest first; returns how many they
// are. Heap sort, as of the crossings. Nothing has been taken yet: `distance2` is infinite before
// and after, and holds depths meanwhile.
static inline uint ox_order_by_depth(__global ox_candidate* candidates, uint count, uint kind) {
  uint ordered = 0u;
  for (uint i = 0u; i < count; ++i)
    if (ox_kind(candidates + i) == kind) {
      const ox_ordered next = {i, candidates[i].depth};
      ox_put_ordered(candidates, ordered++, next);
    }
  for (uint i = ordered / 2u; i-- > 0u;)
    ox_sift_candidates(candidates, i, ordered, ox_ordered_at(candidates, i));
  for (uint end = ordered; end > 1u; --end) {
    const ox_ordered least = ox_ordered_at(candidates, end - 1u);
    ox_put_ordered(candidates, end - 1u, ox_ordered_at(candidates, 0u));
    ox_sift_candidates(candidates, 0u, end - 1u, least);
  }
  for (uint k = 0u; k < ordered; ++k) candidates[k].distance2 = INFINITY;
  return ordered;
}

#endif
#endif
