// SPDX-License-Identifier: BSD-3-Clause
// The way that a plane sends a point: whether it comes out there, and whether another is shorter.
// Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_WAYS_H
#define ODE_EXT_KERNELS_CONTACTS_WAYS_H

#include "contacts/region.h"
#include "lib/closest.h"
#include "lib/full_ray.h"

// Normals of planes that do not separate, few at most: what faces their way does not either. Of a
// whole region that is what faces the same way. Of a unit it is only what may be of the same facet:
// beside the thread of a bolt the face next to one that does not separate may do so.
#define OX_WAY_OF_UNIT (1.0f - 0.5f * OX_FACET_ANGLE * OX_FACET_ANGLE)  // the cosine
typedef struct {
  float3 normal[OX_FEW];
  uint count;
} ox_refused;

static inline void ox_refuse(ox_refused* refused, const ox_plane* plane) {
  refused->normal[refused->count++] = plane->normal;
}

static inline bool ox_is_refused(const ox_refused* refused, const ox_plane* plane, float cosine) {
  for (uint i = 0u; i < refused->count; ++i)
    if (ox_dot(refused->normal[i], plane->normal) > cosine) return true;
  return false;
}

static inline __global const ox_mesh* ox_target_of(const ox_region_view* r, uint side) {
  return r->scene->meshes + r->scene->pairs[r->pair].mesh[1u - side];
}

// A point of the frame of B in that of the mesh which mesh `side` is in; from their bases.
static inline float3 ox_in_target(const ox_region_view* r, uint side, float3 p) {
  return side == 0u ? p : ox_transform_from_base(r->scene->pairs + r->pair, 1u, p);
}

static inline float3 ox_target_base(const ox_region_view* r, uint side) {
  return ox_base(r->scene->pairs + r->pair, 1u - side);
}

// Whether a point of mesh `side`, which was taken along `away`, is inside the other. Of an open
// mesh it is not known.
static inline bool ox_is_still_inside(const ox_region_view* r, uint side, float3 p, float3 away) {
  __global const ox_mesh* target = ox_target_of(r, side);
  if ((target->flags & OX_MESH_CLOSED) == 0u) return false;
  return ox_winds_about(ox_target_base(r, side), ox_in_target(r, side, p),
                        side == 0u ? away : ox_rotate(r->scene->pairs + r->pair, 1u, away),
                        r->scene->pairs[r->pair].epsilon, target, &r->scene->surfaces);
}

// How far it is past a plane, for a point so deep below it, to where it is not on it [m].
static inline float ox_way_past(const ox_region_view* r, float depth) {
  return depth + OX_MARGIN * r->scene->pairs[r->pair].epsilon;
}

// Whether what a plane clears is no deeper than what is not known: it touches, and there is nothing
// to be taken out of.
static inline bool ox_only_touches(const ox_region_view* r, const ox_plane_choice* choice) {
  return choice->depth <= OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
}

// Whether a point of mesh `side` is still inside the other where a plane takes it: another part of
// that lies there, or the plane is of one that goes on behind.
static inline bool ox_stays_inside(const ox_region_view* r, uint side, float3 p,
                                   const ox_plane* plane, float depth) {
  const float3 away = ox_way_of(side, plane->normal);
  return ox_is_still_inside(r, side, p + ox_way_past(r, depth) * away, away);
}

// Whether mesh `side`, which the plane clears, goes through a face of the other that looks back: one
// that crosses it, or at a vertex inside it. (The plane of a face of A has the face's normal
// turned.)
static inline bool ox_goes_through(const ox_region_view* r, const ox_plane* plane, uint side) {
  if ((r->flags & OX_REGION_CROSSED) == 0u) return false;  // one is inside the other
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

// What of mesh `side` has gone through a face that looks back comes back through it once it is moved
// past a plane, unless that is past what the face is of. It is asked of what comes half as far back
// as what comes the farthest [m].
static inline float ox_way_back(float3 back, float3 direction, float depth) {
  return -0.5f * depth * ox_dot(back, direction);
}

// Of an edge of mesh `side` that crosses a face with the normal `back`.
static inline bool ox_edge_comes_back(const ox_region_view* r, uint side,
                                      __global const ox_feature* f, float3 back,
                                      const ox_plane* plane, float depth) {
  const float3 direction = ox_way_of(side, plane->normal);
  __global const ox_edge* edge = r->scene->edges + f->source;
  const uint end = (f->flags & OX_FEATURE_LEAVES) != 0u ? 1u : 0u;
  const float3 p = vload3(0, f->position);
  const float3 beyond = ox_vertex_of(r->scene, r->pair, side, edge->vertex[end]) - p;
  const float height = ox_dot(beyond, back);
  const float part = ox_way_back(back, direction, depth);
  const float3 asked = part < height ? p + part / height * beyond : p + beyond;
  return ox_stays_inside(r, side, asked, plane, depth);
}

// Of mesh `side`, that goes around a vertex with such a face: where the vertex's own mesh is as far
// behind that.
static inline bool ox_comes_back_around(const ox_region_view* r, uint side,
                                        __global const ox_feature* f, float3 back,
                                        const ox_plane* plane, float depth) {
  const float3 direction = ox_way_of(side, plane->normal);
  const float3 inward = vload3(0, r->scene->vertices[f->source].direction);
  const float3 normal = side == 0u ? -inward : -ox_rotate(r->scene->pairs + r->pair, 0u, inward);
  const float cosine = ox_max(ox_dot(normal, back), 0.1f);
  const float3 asked =
      vload3(0, f->position) - ox_way_back(back, direction, depth) / cosine * normal;
  return ox_stays_inside(r, 1u - side, asked, plane, depth);
}

// Whether mesh `side` comes back through any of the faces that it goes through.
static inline bool ox_body_comes_back(const ox_region_view* r, const ox_plane* plane, uint side,
                                      float depth) {
  const float3 direction = ox_way_of(side, plane->normal);
  for (uint k = 0u; k < r->count; ++k) {
    __global const ox_feature* f = ox_feature_of(r, k);
    const bool is_own = ox_side_of(f->flags) == side;
    if (ox_is_vertex(f->flags) == is_own) continue;
    const float3 back = is_own ? ox_normal_of(r->scene, r->pair, 1u - side, f->triangle)
                               : ox_back_of_vertex(r, 1u - side, f->source, direction);
    if (!ox_looks_back(back, direction)) continue;
    if (is_own ? ox_edge_comes_back(r, side, f, back, plane, depth)
               : ox_comes_back_around(r, side, f, back, plane, depth))
      return true;
  }
  return false;
}

// How deep the bodies are that go on beyond the region past a plane that is so deep itself; 0 if
// neither does. What is not seen to come back is taken not to, at twice the price.
static inline float ox_depth_beyond(const ox_region_view* r, const ox_plane* plane, float depth,
                                    float limit) {
  const float worth = OX_WORTH * depth;
  float beyond = 0.0f;
  for (uint side = 0u; side < 2u && !(beyond > limit); ++side) {
    if (!ox_clears_side(plane, side) || !ox_goes_through(r, plane, side)) continue;
    const float of_body = ox_depth_of_body(r, plane, side, limit);
    const bool is_asked = plane->kind != OX_PLANE_EDGES && of_body > worth && worth <= limit;
    beyond =
        ox_max(beyond, is_asked && !ox_body_comes_back(r, plane, side, depth) ? worth : of_body);
  }
  return beyond;
}

// The face of the other mesh that is nearest to a point of mesh `side`, if it is nearer than a
// bound; else OX_PLANE_NONE. `behind`: of those that the point is behind.
static inline ox_plane ox_nearest_of(const ox_region_view* r, uint side, float3 p, float bound,
                                     bool behind) {
  const uint triangle =
      ox_closest_of(&r->scene->surfaces, ox_target_of(r, side), ox_target_base(r, side),
                    ox_in_target(r, side, p), bound, r->scene->pairs[r->pair].epsilon, behind);
  return triangle == OX_NONE ? ox_no_plane()
                             : ox_plane_of_face(r->scene, r->pair, 1u - side, triangle);
}

// GRAPP's ray looks along the normal of the vertex alone.
static inline ox_plane ox_nearest_face(const ox_region_view* r, uint side, float3 p, float bound) {
  return ox_nearest_of(r, side, p, bound, false);
}

#endif
