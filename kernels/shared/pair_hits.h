// SPDX-License-Identifier: BSD-3-Clause
// The hits of the vertices of a pair, among its candidates. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_PAIR_HITS_H
#define ODE_EXT_KERNELS_SHARED_PAIR_HITS_H

#include "shared/candidate_order.h"
#include "shared/crossing_table.h"

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

static inline bool ox_is_inside_hit(const ox_edge_pair* p, uint hit) {
  return hit != OX_NONE && ox_kind(p->candidates + hit) == OX_HIT_INSIDE;
}

// By the vertices at an end of their edges, tells crossings which hits those have; by others than
// the inner ones, that they are covered.
static inline void ox_link_hits(ox_edge_pair* p, uint by) {
  ox_tabulate_crossings(p, by);
  for (uint i = 0u; i < p->hits; ++i) {
    const uint side = (p->candidates[i].side_kind & OX_HIT_SIDE) != 0u ? 1u : 0u;
    const ox_crossing_key key = ox_vertex_key(side, p->candidates[i].vertex);
    for (uint n = ox_first_entry(p, key); n != OX_NONE; n = ox_next_entry(p, n)) {
      __global ox_pair_crossing* c = p->crossings + (n >> 1);
      if (by == OX_BY_INNER_VERTEX)
        c->hit = i;
      else if (ox_is_inside_hit(p, i))
        c->flags |= OX_CROSSING_COVERED;
    }
  }
}

#endif
#endif
