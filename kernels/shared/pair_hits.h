// SPDX-License-Identifier: BSD-3-Clause
// The hits of the vertices of a pair, among its candidates. Device only.
#ifndef ODE_EXT_KERNELS_SHARED_PAIR_HITS_H
#define ODE_EXT_KERNELS_SHARED_PAIR_HITS_H

#include "shared/edge_pair.h"

// What the hits of the vertices of one mesh say.
typedef struct {
  uint inside, fallback;
} ox_hit_count;

static inline ox_hit_count ox_count_hits(const ox_edge_pair* p, uint side) {
  ox_hit_count count = {0u, 0u};
  for (uint i = 0u; i < p->candidate_count; ++i) {
    const uint kind = p->candidates[i].side_kind;
    if (((kind & OX_HIT_SIDE) != 0u) != (side != 0u)) continue;
    if ((kind & OX_HIT_KIND) == OX_HIT_INSIDE) ++count.inside;
    if ((kind & OX_HIT_KIND) == OX_HIT_FALLBACK) ++count.fallback;
  }
  return count;
}

// The hit of a vertex that is inside; OX_NONE: it has none.
static inline uint ox_find_hit(const ox_edge_pair* p, uint side, uint vertex) {
  for (uint i = 0u; i < p->candidate_count; ++i) {
    __global const ox_candidate* c = p->candidates + i;
    if (c->vertex == vertex && (c->side_kind & OX_HIT_POINT) == 0u &&
        (c->side_kind & OX_HIT_KIND) == OX_HIT_INSIDE &&
        ((c->side_kind & OX_HIT_SIDE) != 0u) == (side != 0u))
      return i;
  }
  return OX_NONE;
}

static inline bool ox_has_hit(const ox_edge_pair* p, uint side, uint vertex) {
  return ox_find_hit(p, side, vertex) != OX_NONE;
}

#endif
