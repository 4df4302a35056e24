// SPDX-License-Identifier: BSD-3-Clause
// The crossings of a pair, ordered and linked: chords, and neighbours along the curve in which the
// two surfaces meet. Everything is in the frame of B. Device only.
//
// The curve runs through pairs of facets, one of each mesh. It leaves such a pair where an edge of
// either facet crosses the other facet; so two crossings follow one another on the curve if they
// have a pair of facets in common.
#ifndef ODE_EXT_KERNELS_SHARED_EDGE_PAIR_H
#define ODE_EXT_KERNELS_SHARED_EDGE_PAIR_H

#include "shared/edge_ray.h"

typedef struct {
  __global const ox_pair* pair;
  __global const ox_mesh* mesh[2];
  __global const ox_vertex* vertices;
  __global const ox_edge* edges;
  __global const ox_triangle* triangles;
  __global const uint* facets;
  __global ox_edge_crossing* crossings;
  __global uint* order;  // of the crossings
  __global uint* queue;  // as many
  uint count;
  uint regions;
  __global ox_candidate* candidates;
  uint candidate_count, most_candidates;
} ox_edge_pair;

static inline uint ox_side(__global const ox_edge_crossing* crossing) {
  return crossing->pair_side & 1u;
}

static inline float3 ox_vertex_in_b(const ox_edge_pair* p, uint mesh, uint vertex) {
  const float3 position = vload3(0, p->vertices[vertex].position);
  return mesh == 0u ? ox_place(p->pair, 0u, position) : position;
}

static inline float3 ox_normal_in_b(const ox_edge_pair* p, uint mesh, uint triangle) {
  const float3 normal = vload3(0, p->triangles[triangle].normal);
  return mesh == 0u ? ox_turn(p->pair, 0u, normal) : normal;
}

// A line along an edge.
typedef struct {
  float3 from, along;  // along: unit
  float length;
} ox_line;

static inline ox_line ox_line_of(const ox_edge_pair* p, uint mesh, uint edge) {
  ox_line line;
  line.from = ox_vertex_in_b(p, mesh, p->edges[edge].vertex[0]);
  const float3 d = ox_vertex_in_b(p, mesh, p->edges[edge].vertex[1]) - line.from;
  line.length = sqrt(ox_dot(d, d));
  line.along = d / line.length;  // edges that cross have a length
  return line;
}

static inline uint ox_facet_at(const ox_edge_pair* p, uint edge, uint k) {
  const uint triangle = p->edges[edge].triangle[k];
  return triangle == OX_NONE ? OX_NONE : p->facets[triangle];
}

static inline bool ox_is_at_facet(const ox_edge_pair* p, uint edge, uint facet) {
  return ox_facet_at(p, edge, 0u) == facet || ox_facet_at(p, edge, 1u) == facet;
}

// By edge and along it, or by the facet that is crossed.
static inline bool ox_comes_before(const ox_edge_pair* p, bool by_facet, uint i, uint j) {
  __global const ox_edge_crossing* a = p->crossings + i;
  __global const ox_edge_crossing* b = p->crossings + j;
  if (ox_side(a) != ox_side(b)) return ox_side(a) < ox_side(b);
  if (by_facet && a->facet != b->facet) return a->facet < b->facet;
  if (a->edge != b->edge) return a->edge < b->edge;
  if (a->t != b->t) return a->t < b->t;
  return a->triangle < b->triangle;
}

// Heap sort: no recursion, no memory.
static inline void ox_sift(const ox_edge_pair* p, bool by_facet, uint root, uint end) {
  __global uint* order = p->order;
  for (;;) {
    uint child = 2u * root + 1u;
    if (child >= end) return;
    if (child + 1u < end && ox_comes_before(p, by_facet, order[child], order[child + 1u])) ++child;
    if (!ox_comes_before(p, by_facet, order[root], order[child])) return;
    const uint swap = order[root];
    order[root] = order[child];
    order[child] = swap;
    root = child;
  }
}

static inline void ox_sort_crossings(const ox_edge_pair* p, bool by_facet) {
  for (uint i = p->count / 2u; i-- > 0u;) ox_sift(p, by_facet, i, p->count);
  for (uint end = p->count; end > 1u; --end) {
    const uint swap = p->order[0];
    p->order[0] = p->order[end - 1u];
    p->order[end - 1u] = swap;
    ox_sift(p, by_facet, 0u, end - 1u);
  }
}

// The stretch of each edge inside the target: from where it enters to where it leaves next, or to
// the end of the edge. Needs the order by edge.
static inline void ox_find_chords(const ox_edge_pair* p) {
  for (uint first = 0u, next; first < p->count; first = next) {
    __global const ox_edge_crossing* begin = p->crossings + p->order[first];
    for (next = first + 1u; next < p->count; ++next) {
      __global const ox_edge_crossing* c = p->crossings + p->order[next];
      if (c->edge != begin->edge || ox_side(c) != ox_side(begin)) break;
    }
    const ox_line line = ox_line_of(p, ox_side(begin), begin->edge);
    uint entry = OX_NONE;
    for (uint i = first; i < next; ++i) {
      __global ox_edge_crossing* c = p->crossings + p->order[i];
      if (c->leaves == 0u) {
        entry = p->order[i];
        continue;
      }
      c->other = entry;
      c->other_t = entry == OX_NONE ? 0.0f : p->crossings[entry].t;
    }
    uint exit = OX_NONE;
    for (uint i = next; i-- > first;) {
      __global ox_edge_crossing* c = p->crossings + p->order[i];
      if (c->leaves != 0u) {
        exit = p->order[i];
        continue;
      }
      c->other = exit;
      c->other_t = exit == OX_NONE ? line.length : p->crossings[exit].t;
    }
  }
}

// The vertex inside at the end of the chord; OX_NONE: both ends are crossings.
static inline uint ox_inner_vertex(const ox_edge_pair* p, __global const ox_edge_crossing* c) {
  if (c->other != OX_NONE) return OX_NONE;
  return p->edges[c->edge].vertex[c->leaves != 0u ? 0u : 1u];
}

// The first place in the order by facet whose (side, facet) is not less.
static inline uint ox_find_facet(const ox_edge_pair* p, uint side, uint facet) {
  uint low = 0u;
  uint high = p->count;
  while (low < high) {
    const uint middle = (low + high) / 2u;
    __global const ox_edge_crossing* c = p->crossings + p->order[middle];
    if (ox_side(c) < side || (ox_side(c) == side && c->facet < facet))
      low = middle + 1u;
    else
      high = middle;
  }
  return low;
}

static inline bool ox_crosses(const ox_edge_pair* p, uint place, uint side, uint facet) {
  if (place >= p->count) return false;
  __global const ox_edge_crossing* c = p->crossings + p->order[place];
  return ox_side(c) == side && c->facet == facet;
}

// Puts a crossing into a region, unless it is in one.
static inline void ox_reach(const ox_edge_pair* p, uint i, uint region, uint* end) {
  if (p->crossings[i].region != OX_NONE) return;
  p->crossings[i].region = region;
  p->queue[(*end)++] = i;
}

// The neighbours of crossing i, along the curve and along its chord.
static inline void ox_reach_neighbours(const ox_edge_pair* p, uint i, uint region, uint* end) {
  __global const ox_edge_crossing* c = p->crossings + i;
  if (c->other != OX_NONE) ox_reach(p, c->other, region, end);
  const uint side = ox_side(c);
  const uint facet0 = ox_facet_at(p, c->edge, 0u);
  const uint facet1 = ox_facet_at(p, c->edge, 1u);
  for (uint k = 0u; k < 2u; ++k) {  // an edge of the facet it crosses crosses a facet at its edge
    const uint facet = k == 0u ? facet0 : facet1;
    if (facet == OX_NONE || (k == 1u && facet1 == facet0)) continue;
    for (uint n = ox_find_facet(p, 1u - side, facet); ox_crosses(p, n, 1u - side, facet); ++n)
      if (ox_is_at_facet(p, p->crossings[p->order[n]].edge, c->facet))
        ox_reach(p, p->order[n], region, end);
  }
  // Another edge of a facet at its edge crosses the same facet.
  for (uint n = ox_find_facet(p, side, c->facet); ox_crosses(p, n, side, c->facet); ++n) {
    const uint edge = p->crossings[p->order[n]].edge;
    if (ox_is_at_facet(p, edge, facet0) || (facet1 != OX_NONE && ox_is_at_facet(p, edge, facet1)))
      ox_reach(p, p->order[n], region, end);
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
      ox_reach_neighbours(p, p->queue[next], p->regions, &end);
    if (end != begin) ++p->regions;
  }
}

static inline void ox_add_point(ox_edge_pair* p, uint side, uint source, uint target, uint region,
                                float3 position, float3 normal, float depth) {
  if (p->candidate_count == p->most_candidates) return;
  __global ox_candidate* candidate = p->candidates + p->candidate_count++;
  vstore3(position, 0, candidate->position);
  vstore3(normal, 0, candidate->normal);
  candidate->depth = depth;
  candidate->t = depth;
  candidate->side_kind = (side != 0u ? OX_HIT_SIDE : 0u) | OX_HIT_POINT |
                         (depth > p->pair->epsilon ? OX_HIT_INSIDE : OX_HIT_TOUCHING);
  candidate->vertex = source;
  candidate->triangle = target;
  candidate->patch = OX_NONE;
  candidate->distance2 = INFINITY;
  candidate->region = region;
  candidate->outline = 0u;
  candidate->stands = 0u;
}

#endif
