// SPDX-License-Identifier: BSD-3-Clause
// Which crossings of a pair have a pair of facets in common, and so which regions of overlap there
// are. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_REGIONS_H
#define ODE_EXT_KERNELS_SHARED_REGIONS_H

#include "shared/crossing_table.h"

// Puts a crossing into a region, unless it is in one.
static inline void ox_reach(const ox_edge_pair* p, uint i, uint region, uint* end) {
  if (p->crossings[i].region != OX_NONE) return;
  p->crossings[i].region = region;
  p->by_region[(*end)++] = i;
}

// The neighbours of crossing i, along its chord and along the curve: an edge of the facet that it
// crosses crosses a facet at its edge; another edge of a facet at its edge crosses the same facet.
// Either has a pair of facets in common with it.
static inline void ox_reach_neighbours(const ox_edge_pair* p, uint i, uint region, uint* end) {
  __global const ox_pair_crossing* c = p->crossings + i;
  if (c->other != OX_NONE) ox_reach(p, c->other, region, end);
  for (uint k = 0u; k < 2u; ++k) {
    if (c->at[k] == OX_NONE || (k == 1u && c->at[1] == c->at[0])) continue;
    const ox_crossing_key key = ox_facets_key(ox_side(c), c->at[k], c->facet);
    for (uint n = ox_first_entry(p, key); n != OX_NONE; n = ox_next_entry(p, n))
      ox_reach(p, n >> 1, region, end);
  }
}

// The regions of overlap: what hangs together along curves and chords. Needs the order by facet,
// and the table by facets.
static inline void ox_find_regions(ox_edge_pair* p) {
  uint end = 0u;
  p->regions = 0u;
  for (uint k = 0u; k < p->count; ++k) {
    const uint begin = end;
    ox_reach(p, p->order[k], p->regions, &end);
    for (uint next = begin; next < end; ++next)
      ox_reach_neighbours(p, p->by_region[next], p->regions, &end);
    if (end == begin) continue;
    p->region_first[p->regions++] = begin;
  }
  // So far in the order in which they were reached; now in the order by facet within each region.
  for (uint k = 0u; k < p->count; ++k) {
    const uint i = p->order[k];
    p->by_region[p->region_first[p->crossings[i].region]++] = i;
  }
  for (uint region = p->regions; region-- > 1u;)
    p->region_first[region] = p->region_first[region - 1u];
  p->region_first[0] = 0u;
}

#endif
#endif
