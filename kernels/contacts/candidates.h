// SPDX-License-Identifier: BSD-3-Clause
// Candidates for contacts: where a plane parts a region, and how deep. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_CANDIDATES_H
#define ODE_EXT_KERNELS_CONTACTS_CANDIDATES_H

#include "contacts/candidate_list.h"
#include "contacts/clear_units.h"

// Where candidates go, as they come.
typedef struct {
  const ox_region_view* region;
  ox_fields candidates;  // of the pair
  __global uint* count;
  uint manifold;
} ox_manifold;

// What a candidate is of, in A and in B: OX_OF.
typedef struct {
  uint feature[2];
} ox_touch;

// A vertex, or an edge, at a triangle of the other mesh.
static inline ox_touch ox_touch_of(__global const ox_feature* f, uint triangle) {
  const uint side = ox_side_of(f->flags);
  ox_touch touch;
  touch.feature[side] = OX_OF(ox_is_vertex(f->flags) ? OX_OF_VERTEX : OX_OF_EDGE, f->source);
  touch.feature[1u - side] = OX_OF(OX_OF_FACET, triangle);
  return touch;
}

// By one work-item.
static inline void ox_add_candidate(const ox_manifold* m, const ox_plane_choice* choice, uint side,
                                    float3 position, float depth, uint kind, uint source,
                                    uint target, ox_touch touch) {
  const uint i = ox_fetch_add_own(m->region->scene, m->count, 1u);
  const ox_fields* list = &m->candidates;
  ox_set_vector(list, OX_CANDIDATE_POSITION, i, position);
  ox_set_vector(list, OX_CANDIDATE_NORMAL, i, choice->plane.normal);
  ox_floats_of(list, OX_CANDIDATE_DEPTH)[i] = depth;
  ox_words_of(list, OX_CANDIDATE_SIDE_KIND)[i] = (side != 0u ? OX_HIT_SIDE : 0u) | kind;
  ox_words_of(list, OX_CANDIDATE_VERTEX)[i] = source;
  ox_words_of(list, OX_CANDIDATE_TRIANGLE)[i] = target;
  ox_words_of(list, OX_CANDIDATE_MANIFOLD)[i] = m->manifold;
  ox_words_of(list, OX_CANDIDATE_REGION)[i] = OX_REGION_KEY(m->region->index, m->region->flags);
  ox_floats_of(list, OX_CANDIDATE_DISTANCE2)[i] = INFINITY;
  ox_words_of(list, OX_CANDIDATE_TAKEN)[i] = 0u;
  for (uint k = 0u; k < 2u; ++k) ox_words_of(list, OX_CANDIDATE_FEATURE + k)[i] = touch.feature[k];
}

// Whether a crossing lies on the facet of the plane: on the rim, where the body comes out.
static inline bool ox_is_on_rim(const ox_region_view* r, __global const ox_feature* f,
                                const ox_plane* plane) {
  if (ox_is_vertex(f->flags) || plane->kind == OX_PLANE_EDGES) return false;
  const uint facet = ox_facet_of(r->scene, plane->id[0]);
  const uint of = plane->kind == OX_PLANE_FACE_OF_A ? 0u : 1u;
  if (ox_side_of(f->flags) != of) return ox_facet_of(r->scene, f->triangle) == facet;
  return ox_facet_of(r->scene, f->at[0]) == facet ||
         (f->at[1] != OX_NONE && ox_facet_of(r->scene, f->at[1]) == facet);
}

// [m] how deep a crossing of mesh `side` is below a plane. Where it lies depends on how much larger
// A was made.
static inline float ox_crossing_depth(const ox_manifold* m, const ox_plane* plane, uint side,
                                      float3 position) {
  const float grown = OX_INFLATION * m->region->scene->pairs[m->region->pair].epsilon;
  return ox_max(ox_plane_depth(plane, side, position) - grown, 0.0f);
}

// By one work-item. A crossing that a pair of edges clears; the triangles are of these, which have
// the normal.
static inline void ox_add_crossing_at_edges(const ox_manifold* m, const ox_plane_choice* choice,
                                            __global const ox_feature* f) {
  __global const ox_edge* edges = m->region->scene->edges;
  const uint side = ox_side_of(f->flags);
  const float3 position = vload3(0, f->position);
  ox_add_candidate(m, choice, side, position, ox_crossing_depth(m, &choice->plane, side, position),
                   OX_HIT_POINT, edges[choice->plane.id[side]].triangle[0],
                   edges[choice->plane.id[1u - side]].triangle[0], ox_touch_of(f, f->triangle));
}

// By one work-item; of a vertex past the plane of a face alone.
static inline void ox_add_feature_contact(const ox_manifold* m, const ox_plane_choice* choice,
                                          __global const ox_feature* f) {
  if (choice->plane.kind == OX_PLANE_EDGES) {
    ox_add_crossing_at_edges(m, choice, f);
    return;
  }
  const uint of = choice->plane.kind == OX_PLANE_FACE_OF_A ? 0u : 1u;
  const uint side = 1u - of;  // that moves past the plane
  const float3 position = vload3(0, f->position);
  const ox_scene* scene = m->region->scene;
  // Of the triangles of a facet the one that it met.
  const bool met = f->triangle != OX_NONE && ox_side_of(f->flags) == side &&
                   ox_facet_of(scene, f->triangle) == ox_facet_of(scene, choice->plane.id[0]);
  const uint target = met ? f->triangle : choice->plane.id[0];
  const bool is_moved = (f->flags & OX_FEATURE_MOVED) != 0u;
  if (ox_is_vertex(f->flags))
    ox_add_candidate(m, choice, side, position,
                     ox_max(ox_plane_depth(&choice->plane, side, position), 0.0f),
                     is_moved ? OX_HIT_POINT : 0u, is_moved ? f->at[0] : f->source, target,
                     ox_touch_of(f, target));
  else  // of the face that it crosses, which no other crossing of the edge does
    ox_add_candidate(m, choice, side, position,
                     ox_crossing_depth(m, &choice->plane, side, position), OX_HIT_POINT,
                     ox_side_of(f->flags) == side ? f->at[0] : f->triangle, target,
                     ox_touch_of(f, f->triangle));
}

// The stretch of the line of an edge that is in the region, in lengths of the edge; false: none is.
// A straight edge may have been cut into many, which are as good as one another: on which of them
// two pass is not for their numbers to say.
static inline bool ox_find_stretch(const ox_region_view* r, uint side, const ox_ridge* ridge,
                                   float* first, float* last) {
  const float3 d = ridge->to - ridge->from;
  const float near = OX_MARGIN * r->scene->pairs[r->pair].epsilon;
  *first = INFINITY;
  *last = -INFINITY;
  for (uint k = OX_ITEM; k < r->count; k += OX_ITEMS) {
    if (ox_side_of(ox_flags_of(r, k)) != side) continue;
    const float3 position = ox_position_of(r, k);
    const float part = ox_dot(position - ridge->from, d) / ox_dot(d, d);
    const float3 off = position - (ridge->from + part * d);
    if (!(ox_dot(off, off) <= near * near)) continue;
    *first = ox_min(*first, part);
    *last = ox_max(*last, part);
  }
  *first = ox_least_of_items(*first);
  *last = -ox_least_of_items(-*last);
  return *first <= *last;
}

// Where an edge of mesh `side` passes one of the other, `part` of its length along it, on the
// stretch of its line that is in the region; else what of its mesh is farthest past the plane.
// False: the region has nothing of it.
static inline bool ox_find_passing(const ox_region_view* r, uint side, const ox_ridge* ridge,
                                   float part, float3 normal, float3* point) {
  float first, last;
  if (ox_find_stretch(r, side, ridge, &first, &last)) {
    *point = ridge->from + clamp(part, first, last) * (ridge->to - ridge->from);
    return true;
  }
  const uint farthest = ox_find_farthest(r, side, normal);
  if (farthest == OX_NONE) return false;
  *point = ox_position_of(r, farthest);
  return true;
}

// Two edges: midway between them, where they pass one another seen along their normal.
static inline void ox_add_edge_contact(const ox_manifold* m, const ox_plane_choice* choice) {
  const ox_region_view* r = m->region;
  const ox_ridge ridge_a = ox_ridge_of(r->scene, r->pair, 0u, choice->plane.id[0]);
  const ox_ridge ridge_b = ox_ridge_of(r->scene, r->pair, 1u, choice->plane.id[1]);
  const float3 a = ridge_a.from;
  const float3 b = ridge_b.from;
  const float3 u = ridge_a.to - a;
  const float3 v = ridge_b.to - b;
  const float3 n = choice->plane.normal;
  const float area = ox_dot(ox_plain_cross(u, v), n);
  const float3 d = b - a;
  float3 on_a = (float3)(0.0f);
  float3 on_b = (float3)(0.0f);
  const bool any_a =
      ox_find_passing(r, 0u, &ridge_a, ox_dot(ox_plain_cross(d, v), n) / area, n, &on_a);
  const bool any_b =
      ox_find_passing(r, 1u, &ridge_b, ox_dot(ox_plain_cross(d, u), n) / area, n, &on_b);
  if (!any_a) on_a = on_b;
  if (!any_b) on_b = on_a;
  ox_touch touch;
  for (uint side = 0u; side < 2u; ++side)
    touch.feature[side] = OX_OF(OX_OF_EDGE, choice->plane.id[side]);
  // Of what is wholly inside the other the points are of the inner mesh alone.
  const uint side = any_a ? 0u : 1u;
  const uint source = side == 0u ? ridge_a.face[0] : ridge_b.face[0];
  const uint target = side == 0u ? ridge_b.face[0] : ridge_a.face[0];
  if (ox_is_first_item())
    ox_add_candidate(m, choice, side, 0.5f * (on_a + on_b), choice->depth, OX_HIT_POINT, source,
                     target, touch);
}

// Contacts of a unit that a plane has cleared just now, of both ends of a chord; returns how many.
// By one work-item.
static inline uint ox_add_cleared(const ox_manifold* m, const ox_plane_choice* choice,
                                  __global const ox_feature* f) {
  uint count = 0u;
  for (uint end = 0u; end < 2u; ++end) {
    if (end == 1u) {
      if (ox_is_vertex(f->flags) || f->partner == OX_NONE) break;
      __global const ox_feature* other = m->region->scene->features + f->partner;
      if (ox_is_vertex(other->flags)) break;  // a unit of its own
      f = other;
    }
    if (ox_is_on_rim(m->region, f, &choice->plane)) continue;
    ox_add_feature_contact(m, choice, f);
    ++count;
  }
  return count;
}

#endif
