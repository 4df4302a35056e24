// SPDX-License-Identifier: BSD-3-Clause
// Who speaks for which region of overlap. Device only.
#ifndef ODE_EXT_KERNELS_SHARED_SPOKESMEN_H
#define ODE_EXT_KERNELS_SHARED_SPOKESMEN_H

#include "shared/pair_hits.h"

// Of several regions each gets one contact that will not be left out for want of room: the deepest
// of its points and of the vertices at its chords, of which so many are looked at.
#define OX_MOST_SPOKESMEN 8u

static inline void ox_choose_spokesmen(const ox_edge_pair* p, uint points) {
  for (uint region = 0u; region < p->regions && p->regions > 1u; ++region) {
    uint best = OX_NONE;
    uint looked = 0u;
    for (uint k = 0u; k < p->count && looked < OX_MOST_SPOKESMEN; ++k) {
      __global const ox_edge_crossing* c = p->crossings + p->order[k];
      if (c->region != region || c->covered == 0u) continue;
      const uint vertex = ox_inner_vertex(p, c);
      if (vertex == OX_NONE) continue;
      const uint hit = ox_find_hit(p, ox_side(c), vertex);
      if (hit == OX_NONE) continue;
      ++looked;
      if (best == OX_NONE || p->candidates[hit].depth > p->candidates[best].depth) best = hit;
    }
    for (uint i = points; i < p->candidate_count; ++i)
      if (p->candidates[i].region == region &&
          (best == OX_NONE || p->candidates[i].depth > p->candidates[best].depth))
        best = i;
    for (uint i = points; i < p->candidate_count; ++i)
      if (p->candidates[i].region == region && i != best) p->candidates[i].region = OX_NONE;
    if (best != OX_NONE) p->candidates[best].region = region;
  }
}

#endif
