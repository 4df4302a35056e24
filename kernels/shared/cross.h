// SPDX-License-Identifier: BSD-3-Clause
// The edges of one meshlet against the triangles of another. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_CROSS_H
#define ODE_EXT_KERNELS_SHARED_CROSS_H

#include "shared/flooded.h"
#include "shared/meshlet.h"
#include "shared/ray_meshlet.h"

// The vertices of a meshlet in the frame of the other one's mesh, and beyond which sides of that
// one's box and slab each lies, a bit for each side.
typedef struct {
  float x[OX_LANES], y[OX_LANES], z[OX_LANES];
  int beyond[OX_LANES];
} ox_near_points;

// False: all lie beyond one side.
static inline bool ox_find_near(__global const ox_pair* pair, uint side,
                                __global const ox_meshlet* source,
                                __global const ox_meshlet* target, ox_near_points* near) {
  const float margin = pair->margin;
  const float3 lo = vload3(0, target->lo) - margin;
  const float3 hi = vload3(0, target->hi) + margin;
  const float3 n = vload3(0, target->slab_normal);
  const float slab_lo = target->slab_lo - margin;
  const float slab_hi = target->slab_hi + margin;
  int beyond_all = -1;
  for (uint block = 0u; block < OX_BLOCKS; ++block) {
    ox_points p;
    ox_place_vertices(pair, side, source, block, &p);
    // Heights round by 4 * 2^-24 of the coordinates, less than epsilon (pair_step.cl).
    const ox_floats height = n.x * p.x + n.y * p.y + n.z * p.z;
    const ox_ints none = 0;
    const ox_ints beyond = (p.x < lo.x ? none + 1 : none) | (p.x > hi.x ? none + 2 : none) |
                           (p.y < lo.y ? none + 4 : none) | (p.y > hi.y ? none + 8 : none) |
                           (p.z < lo.z ? none + 16 : none) | (p.z > hi.z ? none + 32 : none) |
                           (height < slab_lo ? none + 64 : none) |
                           (height > slab_hi ? none + 128 : none);
    ox_store(p.x, block, near->x);
    ox_store(p.y, block, near->y);
    ox_store(p.z, block, near->z);
    ox_store(beyond, block, near->beyond);
    beyond_all &= ox_and_of(&beyond);
  }
  return beyond_all == 0;
}

#define OX_NEW_LEAVES 1u
#define OX_NEW_CONTACT 2u  // it is of one
#define OX_NEW_FLOODED 4u  // of a side that is flooded: linked from the pair's head on

// Crossings of a pair that are yet to be stored.
typedef struct {
  const ox_scene* scene;
  __global ox_edge_crossing* crossings;  // where to
  uint pair;
  uint count;
  uint flags[OX_MOST_AT_ONCE];  // OX_NEW_..., and the side above them
  uint edge[OX_MOST_AT_ONCE];
  uint triangle[OX_MOST_AT_ONCE];
  float t[OX_MOST_AT_ONCE];
} ox_new_crossings;
#define OX_NEW_SIDE_SHIFT 3u

static inline void ox_store_crossings(ox_new_crossings* fresh) {
  if (fresh->count == 0u) return;
  uint stored;
  const uint first = ox_append_many(fresh->scene, OX_LIST_CROSSINGS, fresh->count, &stored);
  __global ox_found* found = fresh->scene->found + fresh->pair;
  uint contacts = 0u;
  for (uint i = 0u; i < stored; ++i) contacts += (fresh->flags[i] & OX_NEW_CONTACT) != 0u ? 1u : 0u;
  uint slot = contacts == 0u ? 0u : atomic_add(&found->crossings, contacts);
  uint head[2] = {OX_NONE, OX_NONE};
  uint tail[2] = {OX_NONE, OX_NONE};
  for (uint i = 0u; i < stored; ++i) {
    const uint flags = fresh->flags[i];
    const uint side = flags >> OX_NEW_SIDE_SHIFT;
    __global ox_edge_crossing* crossing = fresh->crossings + first + i;
    crossing->pair_side = fresh->pair << 1 | side;
    crossing->edge = fresh->edge[i];
    crossing->triangle = fresh->triangle[i];
    crossing->t = fresh->t[i];
    crossing->leaves = flags & OX_NEW_LEAVES;
    crossing->slot = (flags & OX_NEW_CONTACT) != 0u ? slot++ : OX_NONE;
    if ((flags & OX_NEW_FLOODED) == 0u) continue;
    if (head[side] == OX_NONE) tail[side] = first + i;
    crossing->before = head[side];
    head[side] = first + i;
  }
  for (uint side = 0u; side < 2u; ++side)
    if (head[side] != OX_NONE)
      fresh->crossings[tail[side]].before = atomic_xchg(&found->head[side], head[side]);
  fresh->count = 0u;
}

static inline void ox_add_crossing(ox_new_crossings* fresh, uint side, uint edge, uint triangle,
                                   float t, uint flags) {
  const uint i = fresh->count++;
  fresh->flags[i] = flags | side << OX_NEW_SIDE_SHIFT;
  fresh->edge[i] = edge;
  fresh->triangle[i] = triangle;
  fresh->t[i] = t;
  if (fresh->count == OX_MOST_AT_ONCE) ox_store_crossings(fresh);
}

// Every place where an edge of the source crosses the target, a little beyond its ends too: edges
// that meet in a vertex are cast one by one, and none of them may leave it to the other.
static inline void ox_cross_edges(ox_new_crossings* fresh, uint side, bool flooded,
                                  __global const ox_pair* pair, __global const ox_meshlet* source,
                                  __global const ox_meshlet* target, const ox_near_points* near) {
  const float from = -pair->epsilon;
  for (uint e = 0u; e < source->edge_count; ++e) {
    const uint p = OX_END(source->ends, e, 0u);
    const uint q = OX_END(source->ends, e, 1u);
    const bool apart = (source->edges_apart >> e & 1u) != 0u;
    if ((near->beyond[p] & near->beyond[q]) != 0 || !(apart || flooded)) continue;
    const uint flags = (apart ? OX_NEW_CONTACT : 0u) | (flooded ? OX_NEW_FLOODED : 0u);
    const float3 start = (float3)(near->x[p], near->y[p], near->z[p]);
    const float3 along = (float3)(near->x[q], near->y[q], near->z[q]) - start;
    const float length = sqrt(ox_dot(along, along));
    if (length == 0.0f) continue;
    const float limit = length + pair->epsilon;
    const ox_cast cast = ox_cast_from(start, along / length);
    for (uint block = 0u; block < OX_BLOCKS; ++block) {
      ox_floats t, determinant;
      ox_ints met;
      ox_meets_lanes(&cast, target, block, &met, &t, &determinant);
      met &= (t >= from) & (t <= limit);
      if (ox_or_of(&met) == 0) continue;
      int met_lane[OX_VECTOR_WIDTH];
      float t_lane[OX_VECTOR_WIDTH], determinant_lane[OX_VECTOR_WIDTH];
      ox_store(met, 0, met_lane);
      ox_store(t, 0, t_lane);
      ox_store(determinant, 0, determinant_lane);
      for (uint k = 0u; k < OX_VECTOR_WIDTH; ++k)
        if (met_lane[k] != 0)
          ox_add_crossing(fresh, side, source->edge[e],
                          target->triangle_first + OX_VECTOR_WIDTH * block + k, t_lane[k],
                          flags | (determinant_lane[k] < 0.0f ? OX_NEW_LEAVES : 0u));
    }
  }
}

// Vertices that may lie on the surface, or beside it past a ridge or a corner: what is within
// epsilon of a triangle is so of its plane, and within its box and slab. Triangles so small that
// their area underflows have no plane to compute: all vertices may lie on them.
static inline void ox_touch_vertices(ox_new_crossings* fresh, uint side,
                                     __global const ox_pair* pair,
                                     __global const ox_meshlet* source,
                                     __global const ox_meshlet* m, const ox_near_points* near) {
  uint asked = 0u;
  for (uint v = 0u; v < source->vertex_count; ++v) asked |= (near->beyond[v] == 0 ? 1u : 0u) << v;
  if (asked == 0u) return;
  uint touching = 0u;
  for (uint block = 0u; block < OX_BLOCKS; ++block) {
    const ox_floats ax = ox_load(block, m->corner[0][0]);
    const ox_floats ay = ox_load(block, m->corner[0][1]);
    const ox_floats az = ox_load(block, m->corner[0][2]);
    const ox_floats bx = ox_load(block, m->corner[1][0]) - ax;
    const ox_floats by = ox_load(block, m->corner[1][1]) - ay;
    const ox_floats bz = ox_load(block, m->corner[1][2]) - az;
    const ox_floats cx = ox_load(block, m->corner[2][0]) - ax;
    const ox_floats cy = ox_load(block, m->corner[2][1]) - ay;
    const ox_floats cz = ox_load(block, m->corner[2][2]) - az;
    const ox_floats nx = by * cz - bz * cy;
    const ox_floats ny = bz * cx - bx * cz;
    const ox_floats nz = bx * cy - by * cx;
    const ox_floats norm2 = nx * nx + ny * ny + nz * nz;
    const ox_ints triangle =
        (bx != 0.0f) | (by != 0.0f) | (bz != 0.0f) | (cx != 0.0f) | (cy != 0.0f) | (cz != 0.0f);
    const float limit = 2.0f * pair->epsilon;
    for (uint left = asked & ~touching; left != 0u; left &= left - 1u) {
      const uint v = 31u - clz(left & (~left + 1u));
      const ox_floats d = nx * (near->x[v] - ax) + ny * (near->y[v] - ay) + nz * (near->z[v] - az);
      const ox_ints met = ((d * d <= limit * limit * norm2) | (norm2 < 1e-30f)) & triangle;
      if (ox_or_of(&met) != 0) touching |= 1u << v;
    }
  }
  for (; touching != 0u; touching &= touching - 1u)
    ox_add_crossing(fresh, side, OX_NONE,
                    source->vertex_index[31u - clz(touching & (~touching + 1u))], 0.0f,
                    OX_NEW_FLOODED);
}

static inline void ox_cross_side(ox_new_crossings* fresh, uint side, __global const ox_pair* pair,
                                 __global const ox_meshlet* source,
                                 __global const ox_meshlet* target, const ox_near_points* near) {
  __global const ox_mesh* meshes = fresh->scene->meshes;
  const bool flooded =
      ox_is_flooded(fresh->scene, meshes + pair->mesh[side], meshes + pair->mesh[1u - side]);
  ox_cross_edges(fresh, side, flooded, pair, source, target, near);
  if (flooded) ox_touch_vertices(fresh, side, pair, source, target, near);
}

// The edges of either meshlet against the triangles of the other.
static inline void ox_cross_meshlets(const ox_scene* scene, __global ox_edge_crossing* crossings,
                                     const ox_meshlet_pair* both) {
  __global const ox_pair* pair = scene->pairs + both->pair;
  __global const ox_meshlet* a = scene->surfaces.meshlets + both->meshlet[0];
  __global const ox_meshlet* b = scene->surfaces.meshlets + both->meshlet[1];
  ox_near_points near_b;  // vertices of A, in the frame of B
  ox_near_points near_a;
  if (!ox_find_near(pair, 0u, a, b, &near_b) || !ox_find_near(pair, 1u, b, a, &near_a)) return;
  ox_new_crossings fresh;
  fresh.scene = scene;
  fresh.crossings = crossings;
  fresh.pair = both->pair;
  fresh.count = 0u;
  ox_cross_side(&fresh, 0u, pair, a, b, &near_b);
  ox_cross_side(&fresh, 1u, pair, b, a, &near_a);
  ox_store_crossings(&fresh);
}

#endif
#endif
