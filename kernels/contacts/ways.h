// SPDX-License-Identifier: BSD-3-Clause
// The way that a plane sends a point: whether it comes out there, and whether another is shorter.
// Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_WAYS_H
#define ODE_EXT_KERNELS_CONTACTS_WAYS_H

#include "contacts/region.h"
#include "lib/border.h"
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

// Whether a point of mesh `side`, which was taken along `away`, is inside the other mesh, or behind
// that where it is open.
static inline bool ox_is_still_inside(const ox_region_view* r, uint side, float3 p, float3 away) {
  __global const ox_mesh* target = ox_target_of(r, side);
  if ((target->flags & OX_MESH_CLOSED) == 0u)
    return ox_may_be_behind(ox_target_of(r, 1u - side), target) &&
           ox_closest_in_front(r->scene, 2u * r->pair + side, ox_in_target(r, side, p)) != OX_NONE;
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

// What a ray from a point of mesh `side` meets of the other mesh.
static inline ox_nearest ox_cast_into(const ox_region_view* r, uint side, float3 p,
                                      float3 direction) {
  __global const ox_pair* pair = r->scene->pairs + r->pair;
  uint work = 0u;
  const ox_query query =
      ox_endless_query(ox_target_base(r, side), ox_in_target(r, side, p),
                       side == 0u ? direction : ox_rotate(pair, 1u, direction), pair->epsilon);
  return ox_trace(false, &query, ox_target_of(r, side), &r->scene->surfaces, OX_NONE, &work);
}

// The face of the other mesh by which a direction leaves it from a point of mesh `side`;
// OX_PLANE_NONE: the point is not inside.
static inline ox_plane ox_face_along(const ox_region_view* r, uint side, float3 p,
                                     float3 direction) {
  const ox_nearest nearest = ox_cast_into(r, side, p, direction);
  return nearest.back_t < nearest.front_t
             ? ox_plane_of_face(r->scene, r->pair, 1u - side, nearest.back)
             : ox_no_plane();
}

// The face of the other mesh that is nearest to a point of mesh `side`, if it is nearer than a
// bound; else OX_PLANE_NONE. `before` [m]: of those that the point is behind, or in front of by no
// more.
static inline ox_plane ox_nearest_of(const ox_region_view* r, uint side, float3 p, float bound,
                                     float before) {
  const uint triangle =
      ox_closest_of(&r->scene->surfaces, ox_target_of(r, side), ox_target_base(r, side),
                    ox_in_target(r, side, p), bound, r->scene->pairs[r->pair].epsilon, before);
  return triangle == OX_NONE ? ox_no_plane()
                             : ox_plane_of_face(r->scene, r->pair, 1u - side, triangle);
}

// The nearest of the faces that a point is behind, or in front of by the clearance at most: where
// parts of a mesh overlap, the nearest of all may be one that a part has inside another.
static inline ox_plane ox_nearest_behind(const ox_region_view* r, uint side, float3 p,
                                         float bound) {
  return ox_nearest_of(r, side, p, bound, OX_CLEARANCE * r->scene->pairs[r->pair].epsilon);
}

// GRAPP's ray looks along the normal of the vertex alone.
static inline ox_plane ox_nearest_face(const ox_region_view* r, uint side, float3 p, float bound) {
  return ox_nearest_of(r, side, p, bound, INFINITY);
}

#endif
