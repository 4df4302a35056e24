// SPDX-License-Identifier: BSD-3-Clause
// The way out of the target for a part of the source of which no contact says one: the face below
// which its deepest point is least deep. Frame of B. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_WAY_OUT_H
#define ODE_EXT_KERNELS_SHARED_WAY_OUT_H

#include "shared/edge_pair.h"

typedef struct {
  uint side;      // of the source
  uint triangle;  // of the target; OX_NONE: none was found
  float depth;    // [m] of the deepest point below its plane
  float3 normal;  // out of the target
  float3 corner;  // a point of the plane
  bool through;   // it does not end there (ox_goes_through)
} ox_way_out;

static inline ox_way_out ox_no_way_out(void) {
  ox_way_out way;
  way.side = 0u;
  way.triangle = OX_NONE;
  way.depth = INFINITY;
  way.normal = (float3)(0.0f);
  way.corner = (float3)(0.0f);
  way.through = false;
  return way;
}

static inline float ox_depth_below(const ox_way_out* way, float3 point) {
  return ox_dot(way->corner - point, way->normal);
}

static inline ox_way_out ox_through(const ox_edge_pair* p, uint side, uint triangle) {
  ox_way_out way;
  way.side = side;
  way.triangle = triangle;
  way.normal = ox_normal_in_b(p, 1u - side, triangle);
  way.corner = vload3(0, p->surfaces.triangles[triangle].a);
  if (side != 0u) way.corner = ox_place(p->pair, 0u, way.corner);
  way.depth = 0.0f;
  way.through = false;
  return way;
}

// What a ray from a place in the frame of B meets of a mesh.
static inline ox_nearest ox_look(const ox_edge_pair* p, uint mesh, float3 from, float3 direction) {
  ox_query query;
  query.direction = mesh == 1u ? direction : ox_turn(p->pair, 1u, direction);
  query.cast = ox_cast_from(mesh == 1u ? from : ox_place(p->pair, 1u, from), query.direction);
  query.epsilon = p->pair->epsilon;
  query.t_max = INFINITY;
  query.behind = 0.0f;
  query.two_sided = false;
  uint work = 0u;
  return ox_trace_bvh(&query, p->mesh[mesh], &p->surfaces, OX_NONE, &work);
}

// The face of the target through which a ray from a point inside leaves it; OX_NONE: none.
static inline uint ox_exit_face(const ox_edge_pair* p, uint side, float3 from, float3 direction) {
  const ox_nearest nearest = ox_look(p, 1u - side, from, direction);
  if (nearest.touching != OX_NONE) return nearest.touching;  // where it starts
  return nearest.back_t < nearest.front_t ? nearest.back : OX_NONE;
}

static inline float3 ox_chord_end(const ox_edge_pair* p, __global const ox_pair_crossing* c,
                                  uint end) {
  if (end == 0u) return vload3(0, c->position);
  const ox_line line = ox_line_of(p, ox_side(c), c->edge);
  return line.from + c->other_t * line.along;
}

static inline bool ox_is_fallback(const ox_edge_pair* p, uint i, uint side) {
  const uint kind = p->candidates[i].side_kind;
  return (kind & OX_HIT_KIND) == OX_HIT_FALLBACK && (kind & OX_HIT_POINT) == 0u &&
         ((kind & OX_HIT_SIDE) != 0u) == (side != 0u);
}

// Whether the source goes on beyond the target where it crosses it, through a face that looks the
// other way: what is there would follow, so that leaving by `way` does not end there (a corner that
// runs right through a plate).
static inline bool ox_goes_through(const ox_edge_pair* p, const ox_way_out* way,
                                   __global const ox_pair_crossing* c) {
  const uint target = 1u - way->side;
  if (ox_side(c) == way->side)
    return ox_dot(ox_normal_in_b(p, target, c->triangle), way->normal) < -0.1f;
  for (uint k = 0u; k < 2u; ++k) {
    const uint triangle = p->edges[c->edge].triangle[k];
    if (triangle != OX_NONE && ox_dot(ox_normal_in_b(p, target, triangle), way->normal) < -0.1f)
      return true;
  }
  return false;
}

// How deep the source is below the way at a crossing, which lies on both surfaces: there, and at a
// vertex at the end of its chord.
static inline float ox_depth_at(const ox_edge_pair* p, const ox_way_out* way,
                                __global const ox_pair_crossing* c) {
  const float depth = ox_depth_below(way, vload3(0, c->position));
  return c->other == OX_NONE && ox_side(c) == way->side
             ? ox_max(depth, ox_depth_below(way, ox_chord_end(p, c, 1u)))
             : depth;
}

// Whether a way is worse than another, however deep the points are that it was not measured at.
static inline bool ox_is_beaten(const ox_way_out* way, const ox_way_out* by) {
  if (by->triangle == OX_NONE) return false;
  return way->through == by->through ? way->depth > by->depth : way->through;
}

// Makes way->depth that of the deepest point: of the crossings of a region and the vertices at the
// ends of its chords; of the vertices beyond their own exit (`vertices`). Stops once it is beaten.
static inline void ox_measure(const ox_edge_pair* p, uint region, bool vertices,
                              const ox_way_out* best, ox_way_out* way) {
  const uint end = region == OX_NONE ? 0u : ox_region_end(p, region);
  for (uint k = region == OX_NONE ? 0u : p->region_first[region]; k < end; ++k) {
    __global const ox_pair_crossing* c = p->crossings + p->by_region[k];
    way->depth = ox_max(way->depth, ox_depth_at(p, way, c));
    way->through = way->through || ox_goes_through(p, way, c);
    if (ox_is_beaten(way, best)) return;
  }
  for (uint i = 0u; i < p->candidate_count && vertices && !ox_is_beaten(way, best); ++i)
    if (ox_is_fallback(p, i, way->side))
      way->depth = ox_max(way->depth, ox_depth_below(way, vload3(0, p->candidates[i].position)));
}

static inline bool ox_is_better(const ox_edge_pair* p, const ox_way_out* a, const ox_way_out* b) {
  if (b->triangle == OX_NONE) return true;
  if (a->through != b->through) return b->through;
  if (a->depth != b->depth) return a->depth < b->depth;
  if (a->side != b->side) return a->side < b->side;
  return p->surfaces.triangles[a->triangle].id < p->surfaces.triangles[b->triangle].id;
}

// Keeps the better of two ways out. The order in which they are tried does not matter.
static inline void ox_try_way(const ox_edge_pair* p, uint region, bool vertices, uint side,
                              uint triangle, ox_way_out* best) {
  if (triangle == OX_NONE || triangle == best->triangle) return;
  ox_way_out way = ox_through(p, side, triangle);
  if (ox_dot(way.normal, way.normal) == 0.0f) return;
  ox_measure(p, region, vertices, best, &way);
  if (ox_is_better(p, &way, best)) *best = way;
}

// The vertices beyond their own exit leave that way too, those at least half as deep as the
// deepest.
static inline void ox_lead_vertices_out(const ox_edge_pair* p, const ox_way_out* way) {
  for (uint i = 0u; i < p->candidate_count; ++i) {
    if (!ox_is_fallback(p, i, way->side)) continue;
    __global ox_candidate* candidate = p->candidates + i;
    const float depth = ox_depth_below(way, vload3(0, candidate->position));
    if (!(depth >= 0.5f * way->depth) || !(depth > 0.0f)) continue;
    candidate->side_kind = (candidate->side_kind & ~OX_HIT_KIND) | OX_HIT_INSIDE;
    candidate->triangle = way->triangle;
    candidate->depth = depth;
    candidate->t = depth;
    vstore3(way->side == 0u ? way->normal : -way->normal, 0, candidate->normal);
  }
}

#endif
#endif
