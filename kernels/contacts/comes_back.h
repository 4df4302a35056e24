// SPDX-License-Identifier: BSD-3-Clause
// Bodies that go on beyond their region: whether what is beyond comes back where a plane takes it,
// so that all of the body has to pass the plane. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_COMES_BACK_H
#define ODE_EXT_KERNELS_CONTACTS_COMES_BACK_H

#include "contacts/ways.h"

// Whether mesh `side`, which the plane clears, crosses a face of the other that looks back. (The
// plane of a face of A has the face's normal turned.)
static inline bool ox_crosses_back(const ox_region_view* r, const ox_plane* plane, uint side) {
  for (uint block = 0u; OX_VECTOR_WIDTH * block < r->plane_count; ++block) {
    const uint through =
        ox_of_kind(&r->planes, block, OX_PLANE_KIND | OX_PLANE_CROSSED,
                   OX_PLANE_CROSSED | (side == 0u ? OX_PLANE_FACE_OF_B : OX_PLANE_FACE_OF_A));
    ox_floats cosine;
    ox_dot_fields(&r->planes, OX_PLANE_NORMAL, block, plane->normal, &cosine);
    const ox_ints looks_back = cosine < OX_LOOKS_BACK;
    if ((ox_mask_of(&looks_back) & through & ox_present_lanes(r->plane_count, block)) != 0u)
      return true;
  }
  return false;
}

// Whether mesh `side`, which the plane clears, goes through a face of the other that looks back:
// one that it crosses, or at a vertex inside it.
static inline bool ox_goes_through(const ox_region_view* r, const ox_plane* plane, uint side) {
  if ((r->flags & OX_REGION_CROSSED) == 0u) return false;  // one is inside the other
  if (ox_crosses_back(r, plane, side)) return true;
  const float3 direction = ox_way_of(side, plane->normal);
  for (uint first = 0u; first < r->count; first += OX_ITEMS) {
    const uint k = first + OX_ITEM;
    const uint flags = k < r->count ? ox_flags_of(r, k) : 0u;
    if (ox_any_item(
            ox_is_vertex(flags) && ox_side_of(flags) != side &&
            ox_looks_back(ox_back_of_vertex(r, 1u - side, ox_feature_of(r, k)->source, direction),
                          direction)))
      return true;
  }
  return false;
}

// A body that has gone through a face that looks back comes back through it when it is moved past
// a plane, but where that takes it past what is behind the face. It is asked of what lands behind
// the face by half of the most that anything can [m].
static inline float ox_way_back(float3 back, float3 direction, float depth) {
  return -0.5f * depth * ox_dot(back, direction);
}

// An edge of mesh `side` that crosses such a face, of which `back` is the normal, and that has been
// taken `aside` as well.
static inline bool ox_edge_comes_back(const ox_region_view* r, uint side,
                                      __global const ox_feature* f, float3 back,
                                      const ox_plane* plane, float depth, float3 aside) {
  const float3 direction = ox_way_of(side, plane->normal);
  __global const ox_edge* edge = r->scene->edges + f->source;
  const uint end = (f->flags & OX_FEATURE_LEAVES) != 0u ? 1u : 0u;
  const float3 p = vload3(0, f->position);
  const float3 beyond = ox_vertex_of(r->scene, r->pair, side, edge->vertex[end]) - p;
  const float height = ox_dot(beyond, back);
  const float part = ox_way_back(back, direction, depth);
  const float3 asked = part < height ? p + part / height * beyond : p + beyond;
  return ox_stays_inside(r, side, asked + aside, plane, depth);
}

// What of mesh `side` is around a vertex at such a face: where the vertex stays inside, as a tip in
// a floor that is moved along one of its flanks, that is around it still. Else what lands is behind
// the face in the vertex's own mesh, which has its middle against the normal there.
static inline bool ox_comes_back_around(const ox_region_view* r, uint side,
                                        __global const ox_feature* f, float3 back,
                                        const ox_plane* plane, float depth) {
  const float3 p = vload3(0, f->position);
  if (ox_stays_inside(r, 1u - side, p, plane, depth)) return true;
  const float3 direction = ox_way_of(side, plane->normal);
  const float3 normal = -ox_inward_at(r, f);
  const float cosine = ox_max(ox_dot(normal, back), -OX_LOOKS_BACK);
  const float3 asked = p - ox_way_back(back, direction, depth) / cosine * normal;
  return ox_stays_inside(r, 1u - side, asked, plane, depth);
}

// To where on an edge what is beyond a crossing is nearer to that than to where the edge is inside
// again: to its end, or half of the way to there [m].
static inline float ox_own_until(const ox_scene* scene, __global const ox_feature* f, float end) {
  return f->next == OX_NONE ? end : 0.5f * (f->t + scene->features[f->next].t);
}

// Whether a stretch of an edge of mesh `side` is in the other: it meets a face, or is all inside.
static inline bool ox_stretch_is_inside(const ox_region_view* r, uint side, float3 from,
                                        float3 direction, float length, float3 away) {
  const ox_nearest nearest = ox_cast_into(r, side, from, direction);
  if (ox_min(nearest.front_t, nearest.back_t) <= length) return true;
  // A ray out of a solid leaves it; where it does not meet a back first, it may be in another part.
  if ((ox_target_of(r, side)->flags & OX_MESH_CLOSED) != 0u) {
    if (nearest.back_t < nearest.front_t) return true;
    if (nearest.front_t == INFINITY) return false;
  }
  return ox_is_still_inside(r, side, from, away);
}

// Whether what of an edge of mesh `side` is about a chord is still in the other mesh where a plane
// takes it. Another chord of the edge is of another region, or has planes of its own.
static inline bool ox_chord_stays(const ox_region_view* r, uint side, uint k, const ox_plane* plane,
                                  float depth) {
  __global const ox_feature* f = ox_feature_of(r, k);
  __global const uint* ends = r->scene->edges[f->source].vertex;
  const float3 away = ox_way_of(side, plane->normal);
  const float3 moved = ox_way_past(r, depth) * away;
  const float3 from = ox_vertex_of(r->scene, r->pair, side, ends[0]);
  const float3 along = ox_vertex_of(r->scene, r->pair, side, ends[1]) - from;
  const float length = sqrt(ox_dot(along, along));
  const float3 direction = along / length;
  // Mostly nothing of all of the edge is.
  if (!ox_stretch_is_inside(r, side, from + moved, direction, length, away)) return false;
  float first = 0.0f;
  float last = length;
  for (uint end = 0u; end < 2u; ++end) {
    if ((f->flags & OX_FEATURE_LEAVES) == 0u)
      first = ox_own_until(r->scene, f, 0.0f);
    else
      last = ox_own_until(r->scene, f, length);
    // Behind what is open it is not known how far.
    if (f->partner == OX_NONE || ox_is_vertex(r->scene->features[f->partner].flags)) break;
    f = r->scene->features + f->partner;
  }
  return ox_stretch_is_inside(r, side, from + first * direction + moved, direction, last - first,
                              away);
}

// Whether mesh `side` comes back through any of the faces that it goes through: its edges cross
// them, or the other mesh has a vertex or an edge there that is in it, as a rod has that goes
// through a plate and out on the other side.
static inline bool ox_body_comes_back(const ox_region_view* r, const ox_plane* plane, uint side,
                                      float depth) {
  const float3 direction = ox_way_of(side, plane->normal);
  for (uint k = 0u; k < r->count; ++k) {
    const uint flags = ox_flags_of(r, k);
    const bool is_own = ox_side_of(flags) == side;
    __global const ox_feature* f = ox_feature_of(r, k);
    if (ox_is_vertex(flags)) {
      if (is_own) continue;
      const float3 back = ox_back_of_vertex(r, 1u - side, f->source, direction);
      if (ox_looks_back(back, direction) && ox_comes_back_around(r, side, f, back, plane, depth))
        return true;
    } else if (is_own) {
      const float3 back = ox_normal_of(r->scene, r->pair, 1u - side, f->triangle);
      if (ox_looks_back(back, direction) &&
          ox_edge_comes_back(r, side, f, back, plane, depth, (float3)(0.0f)))
        return true;
    } else if ((flags & OX_MEMBER_BEGINS) != 0u) {  // each edge once for a chord
      const float3 back = ox_back_of_edge(r, 1u - side, f->source, direction, direction);
      if (ox_looks_back(back, direction) && ox_chord_stays(r, 1u - side, k, plane, depth))
        return true;
    }
  }
  return false;
}

// What a plane costs that is so deep, where a body is not seen to come back through it: twice that,
// as it is asked at few places.
static inline float ox_doubted(float depth) { return OX_WORTH * depth; }

// Whether it is to be asked: all of the body costs more, and that much is within a limit.
static inline bool ox_is_doubted(float of_body, float depth, float limit) {
  return of_body > ox_doubted(depth) && ox_doubted(depth) <= limit;
}

// What the bodies that go on beyond a region make of a plane; 0 where neither does.
typedef struct {
  float price;  // [m] what it costs
  float depth;  // [m] how far they have to go, but for one that is not seen to come back
} ox_beyond;

// Of a plane that the region is so deep below. Of a region of many members, each of which takes a
// ray, it is not asked whether they come back.
static inline ox_beyond ox_go_on_beyond(const ox_region_view* r, const ox_plane* plane, float depth,
                                        float limit) {
  const bool is_asked = r->count <= OX_MANY;
  ox_beyond beyond = {0.0f, 0.0f};
  for (uint side = 0u; side < 2u && !(beyond.price > limit); ++side) {
    if (!ox_clears_side(plane, side) || !ox_goes_through(r, plane, side)) continue;
    const float of_body = ox_depth_of_body(r, plane, side, limit);
    if (is_asked && ox_is_doubted(of_body, depth, limit) &&
        !ox_body_comes_back(r, plane, side, depth)) {
      beyond.price = ox_max(beyond.price, ox_doubted(depth));
    } else {
      beyond.price = ox_max(beyond.price, of_body);
      beyond.depth = ox_max(beyond.depth, of_body);
    }
  }
  return beyond;
}

#endif
