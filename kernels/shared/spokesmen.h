// SPDX-License-Identifier: BSD-3-Clause
// Who speaks for which region of overlap. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_SPOKESMEN_H
#define ODE_EXT_KERNELS_SHARED_SPOKESMEN_H

#include "shared/pair_hits.h"

// Of several regions each gets one contact that will not be left out for want of room: the deepest
// of its points and of the vertices at its chords, of which so many are looked at.
#define OX_MOST_SPOKESMEN 8u

// Of the vertices of a region; OX_NONE: none.
static inline uint ox_deepest_hit(const ox_edge_pair* p, uint region) {
  uint best = OX_NONE;
  uint looked = 0u;
  for (uint k = p->region_first[region]; k < ox_region_end(p, region) && looked < OX_MOST_SPOKESMEN;
       ++k) {
    __global const ox_pair_crossing* c = p->crossings + p->by_region[k];
    if ((c->flags & OX_CROSSING_COVERED) == 0u || !ox_is_inside_hit(p, c->hit)) continue;
    ++looked;
    if (best == OX_NONE || p->candidates[c->hit].depth > p->candidates[best].depth) best = c->hit;
  }
  return best;
}

static inline void ox_choose_spokesmen(const ox_edge_pair* p) {
  if (p->regions < 2u) return;
  __global uint* spokesman = p->point_of_region;  // no longer needed
  for (uint region = 0u; region < p->regions; ++region)
    spokesman[region] = ox_deepest_hit(p, region);
  for (uint i = p->hits; i < p->candidate_count; ++i) {
    __global uint* best = spokesman + p->candidates[i].region;
    if (*best == OX_NONE || p->candidates[i].depth > p->candidates[*best].depth) *best = i;
  }
  for (uint i = p->hits; i < p->candidate_count; ++i) p->candidates[i].region = OX_NONE;
  for (uint region = 0u; region < p->regions; ++region)
    if (spokesman[region] != OX_NONE) p->candidates[spokesman[region]].region = region;
}

#endif
#endif
