// SPDX-License-Identifier: BSD-3-Clause
// The crossings of a pair, ordered and linked: chords, and neighbours along the curve in which the
// two surfaces meet. Everything is in the frame of B. Device only.
//
// The curve runs through pairs of facets, one of each mesh. It leaves such a pair where an edge of
// either facet crosses the other facet; so two crossings follow one another on the curve if they
// have a pair of facets in common.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_EDGE_PAIR_H
#define ODE_EXT_KERNELS_SHARED_EDGE_PAIR_H

#include "shared/append.h"
#include "shared/full_ray.h"

// See crossing_table.h.
typedef struct {
  __global uint* slots;
  __global uint* next;
  uint by;
} ox_crossing_table;

typedef struct {
  __global const ox_pair* pair;
  __global const ox_mesh* mesh[2];
  __global const ox_vertex* vertices;
  __global const ox_edge* edges;
  ox_surfaces surfaces;
  __global ox_pair_crossing* crossings;
  __global uint* order;         // of the crossings (crossing_order.h)
  __global uint* by_region;     // the same, those of a region together
  __global uint* region_first;  // where they start there
  ox_crossing_table table;      // that is needed now
  uint count;
  uint regions;
  __global ox_candidate* candidates;
  uint hits;  // of vertices: the first of the candidates, all others are points
  uint candidate_count, most_candidates;
  // In the room of the table, when that is not needed any more.
  __global uint* point_of_region;  // the first of them; OX_NONE: none (reconcile.h)
  __global uint* next_point;       // of its region, of each point
} ox_edge_pair;

static inline uint ox_region_end(const ox_edge_pair* p, uint region) {
  return region + 1u < p->regions ? p->region_first[region + 1u] : p->count;
}

static inline uint ox_side(__global const ox_pair_crossing* crossing) {
  return crossing->flags & OX_CROSSING_SIDE;
}

static inline bool ox_leaves(__global const ox_pair_crossing* crossing) {
  return (crossing->flags & OX_CROSSING_LEAVES) != 0u;
}

static inline float3 ox_vertex_in_b(const ox_edge_pair* p, uint mesh, uint vertex) {
  const float3 position = vload3(0, p->vertices[vertex].position);
  return mesh == 0u ? ox_place(p->pair, 0u, position) : position;
}

static inline float3 ox_normal_in_b(const ox_edge_pair* p, uint mesh, uint triangle) {
  const float3 normal = vload3(0, p->surfaces.triangles[triangle].normal);
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

static inline bool ox_is_at_facet(__global const ox_pair_crossing* c, uint facet) {
  return c->at[0] == facet || c->at[1] == facet;
}

// The stretch of each edge inside the target: from where it enters to where it leaves next, or to
// the end of the edge. Needs the order by edge.
static inline void ox_find_chords(const ox_edge_pair* p) {
  for (uint first = 0u, next; first < p->count; first = next) {
    __global const ox_pair_crossing* begin = p->crossings + p->order[first];
    for (next = first + 1u; next < p->count; ++next) {
      __global const ox_pair_crossing* c = p->crossings + p->order[next];
      if (c->edge != begin->edge || ox_side(c) != ox_side(begin)) break;
    }
    const ox_line line = ox_line_of(p, ox_side(begin), begin->edge);
    uint entry = OX_NONE;
    for (uint i = first; i < next; ++i) {
      __global ox_pair_crossing* c = p->crossings + p->order[i];
      if (!ox_leaves(c)) {
        entry = p->order[i];
        continue;
      }
      c->other = entry;
      c->other_t = entry == OX_NONE ? 0.0f : p->crossings[entry].t;
    }
    uint exit = OX_NONE;
    for (uint i = next; i-- > first;) {
      __global ox_pair_crossing* c = p->crossings + p->order[i];
      if (ox_leaves(c)) {
        exit = p->order[i];
        continue;
      }
      c->other = exit;
      c->other_t = exit == OX_NONE ? line.length : p->crossings[exit].t;
    }
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
  candidate->listed = 0u;
}

#endif
#endif
