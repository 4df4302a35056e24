// SPDX-License-Identifier: BSD-3-Clause
// The two full ray algorithms (GRAPP section 3.3): stackless traversal of a BVH by skip links, and
// every triangle in turn. Device only.
#ifndef ODE_EXT_KERNELS_SHARED_FULL_RAY_H
#define ODE_EXT_KERNELS_SHARED_FULL_RAY_H

#include "shared/nearest.h"

#define OX_WORK_NODE 1u
#define OX_WORK_TRIANGLE 2u

// `seed`: a triangle that is likely to be near the first hit; OX_NONE: none is known. It only saves
// looking at what lies behind it.
static inline ox_nearest ox_trace_bvh(const ox_query* query, __global const ox_mesh* mesh,
                                      __global const ox_node* all_nodes,
                                      __global const ox_triangle* triangles, uint seed,
                                      uint* work) {
  ox_nearest nearest = ox_nothing();
  const float from = ox_min(-query->epsilon, -query->behind);
  __global const ox_node* nodes = all_nodes + mesh->node_first;
  if (seed != OX_NONE) {
    ox_consider(query, triangles, seed, &nearest);
    *work += OX_WORK_TRIANGLE;
  }
  float limit = ox_limit(query, &nearest);

  for (uint n = 0u; n < mesh->node_count;) {
    __global const ox_node* node = nodes + n;
    *work += OX_WORK_NODE;
    if (!ox_meets_box(&query->cast, node, from, limit)) {
      n = node->skip;
      continue;
    }
    const uint first = mesh->triangle_first + (node->leaf >> 3);
    const uint count = node->leaf & 7u;
    for (uint k = first; k < first + count; ++k) ox_consider(query, triangles, k, &nearest);
    *work += count * OX_WORK_TRIANGLE;
    limit = ox_limit(query, &nearest);
    ++n;
  }
  return nearest;
}

static inline ox_nearest ox_trace_all(const ox_query* query, __global const ox_mesh* mesh,
                                      __global const ox_triangle* triangles, uint* work) {
  ox_nearest nearest = ox_nothing();
  for (uint k = 0u; k < mesh->triangle_count; ++k)
    ox_consider(query, triangles, mesh->triangle_first + k, &nearest);
  *work += mesh->triangle_count * OX_WORK_TRIANGLE;
  return nearest;
}

static inline ox_nearest ox_trace(bool basic, const ox_query* query, __global const ox_mesh* mesh,
                                  __global const ox_node* nodes,
                                  __global const ox_triangle* triangles, uint seed, uint* work) {
  return basic ? ox_trace_all(query, mesh, triangles, work)
               : ox_trace_bvh(query, mesh, nodes, triangles, seed, work);
}

// Whether a vertex whose ray grazes is inside a closed target, by rays in other directions, no two
// of which graze but by a coincidence. Undecided after three: outside.
static inline bool ox_is_inside(bool basic, const ox_query* grazing, __global const ox_mesh* mesh,
                                __global const ox_node* nodes,
                                __global const ox_triangle* triangles, uint* work) {
  for (uint k = 0u; k < 3u; ++k) {
    ox_query query;
    query.direction = k == 0u   ? (float3)(0.5481f, 0.3027f, 0.7797f)
                      : k == 1u ? (float3)(-0.2379f, 0.8711f, -0.4297f)
                                : (float3)(0.3319f, -0.6203f, -0.7107f);
    query.cast = ox_cast_from(grazing->cast.origin, query.direction);
    query.epsilon = grazing->epsilon;
    query.t_max = INFINITY;
    query.behind = 0.0f;
    query.two_sided = false;
    const ox_nearest nearest = ox_trace(basic, &query, mesh, nodes, triangles, OX_NONE, work);
    if (!ox_grazes(&nearest, query.epsilon)) return nearest.back_t < nearest.front_t;
  }
  return false;
}

// The ray of a vertex, in the frame of the target.
typedef struct {
  float3 origin, direction;
  float exit;  // [m] where it leaves its own mesh
  float epsilon;
  bool both_ways;  // the source is a sheet: along -direction too, and the shallower exit counts
} ox_vertex_ray;

static inline ox_vertex_ray ox_ray_of(__global const ox_pair* pair, uint side,
                                      __global const ox_mesh* meshes,
                                      __global const ox_vertex* vertex) {
  __global const ox_mesh* source = meshes + pair->mesh[side];
  __global const ox_mesh* target = meshes + pair->mesh[1u - side];
  ox_vertex_ray ray;
  ray.origin = ox_place(pair, side, vload3(0, vertex->position));
  ray.direction = ox_turn(pair, side, vload3(0, vertex->direction));
  ray.epsilon = pair->epsilon;
  ray.both_ways = (source->flags & OX_MESH_TWO_SIDED) != 0u;
  ray.exit = vertex->exit;
  const bool closed = (target->flags & OX_MESH_CLOSED) != 0u;
  // A sheet's thickness says nothing about how deep it is in a solid. A sheet that cuts through a
  // solid source parts the vertex's way through it in two: what is on the shorter part is beyond.
  if (ray.both_ways && closed) ray.exit = INFINITY;
  if ((target->flags & OX_MESH_TWO_SIDED) != 0u && (source->flags & OX_MESH_CLOSED) != 0u)
    ray.exit = 0.5f * ray.exit;
  return ray;
}

// Casts it in full. *remember becomes the triangle for the next step, over all meshes; `behind`
// [m]: how far behind the vertex it may be.
static inline ox_outcome ox_cast_in_full(bool basic, const ox_vertex_ray* ray,
                                         __global const ox_mesh* mesh,
                                         __global const ox_node* nodes,
                                         __global const ox_triangle* triangles, uint seed,
                                         float behind, uint* remember, uint* work) {
  const bool closed = (mesh->flags & OX_MESH_CLOSED) != 0u;
  ox_query query;
  query.epsilon = ray->epsilon;
  // Against an open target nothing beyond the source's own exit can be told to be inside.
  query.t_max = closed ? INFINITY : ray->exit + ray->epsilon;
  query.behind = behind;
  query.two_sided = (mesh->flags & OX_MESH_TWO_SIDED) != 0u;
  ox_outcome best = ox_miss();
  *remember = OX_NONE;
  for (uint way = 0u; way < (ray->both_ways ? 2u : 1u); ++way) {
    query.direction = way == 0u ? ray->direction : -ray->direction;
    query.cast = ox_cast_from(ray->origin, query.direction);
    const ox_nearest nearest = ox_trace(basic, &query, mesh, nodes, triangles, seed, work);
    bool inside = false;
    if (closed && ox_grazes(&nearest, query.epsilon))
      inside = ox_is_inside(basic, &query, mesh, nodes, triangles, work);
    const ox_outcome outcome = ox_judge(&query, &nearest, inside, ray->exit, triangles);
    const uint kind = outcome.kind & OX_HIT_KIND;
    const uint best_kind = best.kind & OX_HIT_KIND;
    if (way == 0u || kind < best_kind || (kind == best_kind && outcome.t < best.t)) {
      best = outcome;
      *remember = ox_to_remember(&nearest);
    }
  }
  return best;
}

#endif
