// SPDX-License-Identifier: BSD-3-Clause
// Which crossings of a pair have a pair of facets in common, and so which regions of overlap there
// are. Device only.
#ifndef ODE_EXT_KERNELS_SHARED_REGIONS_H
#define ODE_EXT_KERNELS_SHARED_REGIONS_H

#include "shared/crossing_order.h"

// Where a facet is crossed more often than this, looking through all of its crossings for those of
// one facet takes longer than finding them in an order by both: that is what it costs to sort it.
#define OX_MOST_OF_FACET 64u

// Orders the crossings by facet, and by both facets if some facet is crossed often.
static inline void ox_index_facets(ox_edge_pair* p) {
  const ox_order by_facet = {p->order, p->facet_keys, p->count, OX_BY_FACET};
  ox_sort_crossings(p, &by_facet);
  p->by_facets_count = 0u;
  bool often = false;
  for (uint k = OX_MOST_OF_FACET; k < p->count && !often; ++k)
    often = p->facet_keys[k - OX_MOST_OF_FACET] == p->facet_keys[k];
  if (!often) return;
  for (uint i = 0u; i < p->count; ++i) {
    const uint edge = p->crossings[i].edge;
    const uint facet1 = ox_facet_at(p, edge, 1u);
    p->by_facets[p->by_facets_count++] = i << 1;
    if (facet1 != OX_NONE && facet1 != ox_facet_at(p, edge, 0u))
      p->by_facets[p->by_facets_count++] = i << 1 | 1u;
  }
  const ox_order by_facets = {p->by_facets, p->facet_keys, p->by_facets_count, OX_BY_FACETS};
  ox_sort_crossings(p, &by_facets);
}

// Goes through the crossings of a facet by edges of a side that are at another facet, by edge.
typedef struct {
  uint key;  // of the side and the facet
  uint at;
  uint next;  // in the order by facets, or by facet
} ox_meetings;

static inline ox_meetings ox_meetings_of(const ox_edge_pair* p, uint side, uint facet, uint at) {
  ox_meetings meetings = {ox_key_of(side, facet), at, 0u};
  if (p->by_facets_count == 0u) {
    meetings.next = ox_first_with(p->facet_keys, p->count, meetings.key);
    return meetings;
  }
  uint high = p->by_facets_count;
  while (meetings.next < high) {
    const uint middle = (meetings.next + high) / 2u;
    const uint key = p->facet_keys[middle];
    const uint entry = p->by_facets[middle];
    if (key != meetings.key ? key < meetings.key
                            : ox_facet_at(p, p->crossings[entry >> 1].edge, entry & 1u) < at)
      meetings.next = middle + 1u;
    else
      high = middle;
  }
  return meetings;
}

// OX_NONE: there are no more.
static inline uint ox_next_meeting(const ox_edge_pair* p, ox_meetings* m) {
  if (p->by_facets_count == 0u) {
    while (m->next < p->count && p->facet_keys[m->next] == m->key) {
      const uint i = p->order[m->next++];
      if (ox_is_at_facet(p, p->crossings[i].edge, m->at)) return i;
    }
    return OX_NONE;
  }
  if (m->next == p->by_facets_count || p->facet_keys[m->next] != m->key) return OX_NONE;
  const uint entry = p->by_facets[m->next++];
  return ox_facet_at(p, p->crossings[entry >> 1].edge, entry & 1u) == m->at ? entry >> 1 : OX_NONE;
}

// Puts a crossing into a region, unless it is in one.
static inline void ox_reach(const ox_edge_pair* p, uint i, uint region, uint* end) {
  if (p->crossings[i].region != OX_NONE) return;
  p->crossings[i].region = region;
  p->by_region[(*end)++] = i;
}

// The neighbours of crossing i, along the curve and along its chord.
static inline void ox_reach_neighbours(const ox_edge_pair* p, uint i, uint region, uint* end) {
  __global const ox_edge_crossing* c = p->crossings + i;
  if (c->other != OX_NONE) ox_reach(p, c->other, region, end);
  const uint side = ox_side(c);
  for (uint k = 0u; k < 2u; ++k) {
    const uint facet = ox_facet_at(p, c->edge, k);
    if (facet == OX_NONE || (k == 1u && facet == ox_facet_at(p, c->edge, 0u))) continue;
    // An edge of the facet it crosses crosses a facet at its edge; another edge of a facet at its
    // edge crosses the same facet.
    ox_meetings across = ox_meetings_of(p, 1u - side, facet, c->facet);
    for (uint n = ox_next_meeting(p, &across); n != OX_NONE; n = ox_next_meeting(p, &across))
      ox_reach(p, n, region, end);
    ox_meetings along = ox_meetings_of(p, side, c->facet, facet);
    for (uint n = ox_next_meeting(p, &along); n != OX_NONE; n = ox_next_meeting(p, &along))
      ox_reach(p, n, region, end);
  }
}

// The regions of overlap: what hangs together along curves and chords. Needs the order by facet.
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
