// SPDX-License-Identifier: BSD-3-Clause
// The two full ray algorithms (GRAPP section 3.3): traversal of a BVH, and every triangle in turn.
// Device only.
#ifndef ODE_EXT_KERNELS_LIB_FULL_RAY_H
#define ODE_EXT_KERNELS_LIB_FULL_RAY_H

#include "lib/general_position.h"
#include "lib/meshlet_tree.h"
#include "lib/nearest.h"
#include "lib/ray_meshlet.h"
#include "lib/scene.h"

// In boxes.
#define OX_WORK_TRIANGLE 2u

// *leaves, unless that is 0: how often the ray leaves by triangles of the meshlet more than it
// enters, all along it.
static inline void ox_consider_meshlet(const ox_query* query, const ox_surfaces* surfaces,
                                       __global const ox_meshlet* meshlet, float from,
                                       ox_nearest* nearest, int* leaves) {
  ox_moved_vertices seen;
  ox_shear_vertices(&query->cast, meshlet, &seen);
  for (uint first = 0u; first < meshlet->triangle_count; first += OX_VECTOR_WIDTH) {
    ox_floats t, determinant;
    const float limit = leaves != 0 ? INFINITY : ox_limit(query, nearest);
    uint left = ox_meets_lanes(&query->cast, meshlet, &seen, first / OX_VECTOR_WIDTH, from, limit,
                               &t, &determinant);
    if (left == 0u) continue;
    ox_lane_floats t_of, determinant_of;
    ox_keep_lanes(&t, &t_of);
    ox_keep_lanes(&determinant, &determinant_of);
    for (; left != 0u; left &= left - 1u) {
      const uint k = ox_lowest(left);
      const bool is_back = ox_lane(&determinant_of, k) < 0.0f;
      if (leaves != 0 && ox_lane(&t_of, k) >= 0.0f) *leaves += is_back ? 1 : -1;
      ox_consider_met(query, surfaces->triangles, meshlet->triangle[first + k], ox_lane(&t_of, k),
                      is_back, nearest);
    }
  }
}

// The nearer child of each node first: most of what lies behind the first hit is never looked at.
// `seed`: a triangle that is likely to be near the first hit; OX_NONE: none is known.
static inline ox_nearest ox_trace_bvh(const ox_query* query, __global const ox_mesh* mesh,
                                      const ox_surfaces* surfaces, uint seed, uint* work) {
  ox_nearest nearest = ox_nothing();
  const float from = ox_min(-query->epsilon, -query->behind);
  if (seed != OX_NONE) {
    ox_consider(query, surfaces->triangles, seed, &nearest);
    *work += OX_WORK_TRIANGLE;
  }
  ox_ray_walk walk = ox_begin_ray_walk(mesh);
  for (;;) {
    const uint next = ox_next_on_ray(&walk, &query->cast, mesh, surfaces->nodes, from,
                                     ox_limit(query, &nearest), work);
    if (next == OX_NONE) return nearest;
    __global const ox_meshlet* meshlet = surfaces->meshlets + next;
    ox_consider_meshlet(query, surfaces, meshlet, from, &nearest, 0);
    *work += meshlet->triangle_count * OX_WORK_TRIANGLE;
  }
}

static inline ox_nearest ox_trace_all(const ox_query* query, __global const ox_mesh* mesh,
                                      const ox_surfaces* surfaces, uint* work) {
  ox_nearest nearest = ox_nothing();
  for (uint k = 0u; k < mesh->triangle_count; ++k)
    ox_consider(query, surfaces->triangles, mesh->triangle_first + k, &nearest);
  *work += mesh->triangle_count * OX_WORK_TRIANGLE;
  return nearest;
}

static inline ox_nearest ox_trace(bool basic, const ox_query* query, __global const ox_mesh* mesh,
                                  const ox_surfaces* surfaces, uint seed, uint* work) {
  return basic ? ox_trace_all(query, mesh, surfaces, work)
               : ox_trace_bvh(query, mesh, surfaces, seed, work);
}

// A ray that tells whether its origin is inside: in any direction, but two of which graze by a
// coincidence only, or the other way if that is rather that of `away`. k below OX_ASKING_RAYS.
#define OX_ASKING_RAYS 3u
static inline ox_query ox_asking_query(uint k, float3 base, float3 origin, float3 away,
                                       float epsilon) {
  const float3 direction = k == 0u   ? (float3)(0.5481f, 0.3027f, 0.7797f)
                           : k == 1u ? (float3)(-0.2379f, 0.8711f, -0.4297f)
                                     : (float3)(0.3319f, -0.6203f, -0.7107f);
  return ox_endless_query(base, origin, ox_dot(direction, away) < 0.0f ? -direction : direction,
                          epsilon);
}

// Whether a vertex whose ray grazes is inside a closed target. Undecided after three: outside.
static inline bool ox_is_inside(bool basic, const ox_query* grazing, __global const ox_mesh* mesh,
                                const ox_surfaces* surfaces, uint* work) {
  for (uint k = 0u; k < OX_ASKING_RAYS; ++k) {
    const ox_query query = ox_asking_query(k, grazing->cast.base, grazing->cast.origin,
                                           (float3)(0.0f), grazing->epsilon);
    const ox_nearest nearest = ox_trace(basic, &query, mesh, surfaces, OX_NONE, work);
    if (!ox_grazes(&nearest, query.epsilon)) return nearest.back_t < nearest.front_t;
  }
  return false;
}

// What a ray meets first, and how often it leaves the mesh more than it enters it ahead. One
// through an edge counts twice there. Both in one walk: to stop behind the first hit and begin anew
// where that does not tell takes longer.
static inline ox_nearest ox_trace_through(const ox_query* query, __global const ox_mesh* mesh,
                                          const ox_surfaces* surfaces, int* leaves) {
  uint work = 0u;
  *leaves = 0;
  ox_nearest nearest = ox_nothing();
  ox_ray_walk walk = ox_begin_ray_walk(mesh);
  for (;;) {
    const uint next = ox_next_on_ray(&walk, &query->cast, mesh, surfaces->nodes, -query->epsilon,
                                     INFINITY, &work);
    if (next == OX_NONE) return nearest;
    ox_consider_meshlet(query, surfaces, surfaces->meshlets + next, -query->epsilon, &nearest,
                        leaves);
  }
}

// Whether a point that is not near the surface is inside a closed mesh, which may cut itself: the
// surface winds about it. What is met first tells if that is a back face; behind a front face there
// may be the wall of another part that the point is in. Rays go the way of `away`, to where less is
// to be met; 0: any way. Where each grazes, as where every one leaves a part and enters the next at
// once, two of three decide by how often they leave and enter all of it, whichever comes first. The
// point is from a base on, in the frame of the mesh.
static inline bool ox_winds_about(float3 base, float3 point, float3 away, float epsilon,
                                  __global const ox_mesh* mesh, const ox_surfaces* surfaces) {
  uint leaving = 0u;
  for (uint k = 0u; k < OX_ASKING_RAYS; ++k) {
    const ox_query query = ox_asking_query(k, base, point, away, epsilon);
    int more;
    const ox_nearest nearest = ox_trace_through(&query, mesh, surfaces, &more);
    const bool grazes = ox_grazes(&nearest, epsilon);
    if (!grazes && !nearest.entered && nearest.back_t < nearest.front_t) return true;
    const bool leaves = (nearest.entered || nearest.front != OX_NONE) && more > 0;
    if (!grazes) return leaves;
    leaving += leaves ? 1u : 0u;
  }
  return 2u * leaving > OX_ASKING_RAYS;
}

// The ray of a vertex, in the frame of the target.
typedef struct {
  float3 base, origin, direction;  // the origin from the base on
  float ahead;  // [m] how far before its vertex it starts: as in general position
  float exit;   // [m] where it leaves its own mesh
  float epsilon;
  bool both_ways;   // the source is a sheet: along -direction too, and the shallower exit counts
  bool known;       // its vertex is inside
  uint sheet_side;  // OX_SHEET_...: then a sheet's goes away from the body alone
} ox_vertex_ray;

static inline ox_vertex_ray ox_ray_of(__global const ox_pair* pair, uint side,
                                      __global const ox_mesh* meshes,
                                      __global const ox_vertex* vertex, uint sheet_side) {
  __global const ox_mesh* source = meshes + pair->mesh[side];
  __global const ox_mesh* target = meshes + pair->mesh[1u - side];
  ox_vertex_ray ray;
  ray.direction = ox_rotate(pair, side, vload3(0, vertex->direction));
  ray.ahead = OX_INFLATION * pair->epsilon;
  ray.base = ox_base(pair, 1u - side);
  ray.origin = ox_place(pair, side, vload3(0, vertex->position)) - ray.ahead * ray.direction;
  ray.epsilon = pair->epsilon;
  ray.both_ways = (source->flags & OX_MESH_TWO_SIDED) != 0u;
  ray.exit = vertex->exit;
  ray.known = false;
  ray.sheet_side = sheet_side;
  const bool closed = (target->flags & OX_MESH_CLOSED) != 0u;
  // A sheet's thickness says nothing about how deep it is in a solid. A sheet that cuts through a
  // solid source, of which it is not known where that is, parts the vertex's way through it in two:
  // what is on the shorter part is beyond.
  if (ray.both_ways && closed) ray.exit = INFINITY;
  if ((target->flags & OX_MESH_TWO_SIDED) != 0u && (source->flags & OX_MESH_CLOSED) != 0u &&
      sheet_side == OX_SHEET_UNTOLD)
    ray.exit = 0.5f * ray.exit;
  ray.exit += ray.ahead;
  return ray;
}

// Whether a way of a vertex that is known to be inside enters the target. Beside a wall it may be
// outside by as much as the target was made larger, and then the way leaves by the far end. In
// front of a face it is inside if another part is around it.
static inline bool ox_way_enters(const ox_vertex_ray* ray, const ox_query* query,
                                 const ox_nearest* nearest, __global const ox_mesh* mesh,
                                 const ox_surfaces* surfaces) {
  if (nearest->entered) return true;
  return nearest->front_t < nearest->back_t &&
         !ox_winds_about(ray->base, ray->origin + ray->ahead * ray->direction, query->direction,
                         ray->epsilon, mesh, surfaces);
}

// Casts it in full. Of a sheet a way is all that is known: one that enters is none. *remember
// becomes the triangle for the next pass, over all meshes; `behind` [m]: how far behind the vertex
// it may be.
static inline ox_outcome ox_cast_in_full(bool basic, const ox_vertex_ray* ray,
                                         __global const ox_mesh* mesh, const ox_surfaces* surfaces,
                                         uint seed, float behind, uint* remember, uint* work) {
  const bool closed = (mesh->flags & OX_MESH_CLOSED) != 0u;
  ox_query query;
  query.epsilon = ray->epsilon;
  // Against an open target nothing beyond the source's own exit can be told to be inside.
  query.t_max = closed ? INFINITY : ray->exit + ray->epsilon;
  query.behind = behind;
  query.entry = closed && !ray->known ? ray->ahead : 0.0f;
  query.known = ray->known;
  query.two_sided = (mesh->flags & OX_MESH_TWO_SIDED) != 0u;
  query.sheet_side = ray->sheet_side;
  ox_outcome best = ox_miss();
  *remember = OX_NONE;
  const uint first_way = ray->both_ways && ray->sheet_side == OX_SHEET_BACK ? 1u : 0u;
  const uint end_way = ray->both_ways && ray->sheet_side != OX_SHEET_FRONT ? 2u : 1u;
  for (uint way = first_way; way < end_way; ++way) {
    query.direction = way == 0u ? ray->direction : -ray->direction;
    const float3 origin =
        way == 0u ? ray->origin : ray->origin + 2.0f * ray->ahead * ray->direction;
    query.cast = ox_cast_from(ray->base, origin, query.direction);
    const ox_nearest nearest = ox_trace(basic, &query, mesh, surfaces, seed, work);
    if (ray->both_ways && ray->known && ox_way_enters(ray, &query, &nearest, mesh, surfaces))
      continue;
    bool inside = false;
    if (closed && !ray->known && ox_grazes(&nearest, query.epsilon))
      inside = ox_is_inside(basic, &query, mesh, surfaces, work);
    const ox_outcome outcome = ox_judge(&query, &nearest, inside, ray->exit, surfaces->triangles);
    const uint kind = outcome.kind & OX_HIT_KIND;
    const uint best_kind = best.kind & OX_HIT_KIND;
    if (way == first_way || kind < best_kind || (kind == best_kind && outcome.t < best.t)) {
      best = outcome;
      *remember = ox_to_remember(&nearest);
    }
  }
  return best;
}

#endif
