// SPDX-License-Identifier: BSD-3-Clause
// Ray step, BVH algorithm (GRAPP section 3.3): where does the ray from this vertex leave the
// target?
//
// in    rays (counter OX_COUNTER_RAYS), pairs, meshes, vertices, nodes, triangles
// out   hits, and per pair their number
// item  1 ray (grid-stride); no barrier, no stack: skip links
// may overflow: OX_COUNTER_HITS
//
// A vertex of the source is in contact where its ray, cast along -normal, first meets a back face
// of the target after leaving the surface it may lie on (Hermann 2008).
#include "shared/ray_triangle.h"

typedef struct {
  float back_t, front_t;  // nearest beyond epsilon; INFINITY: none
  uint back, touching;    // triangles; OX_NONE: none
  bool entered;           // it starts on a front face: on the surface, going in
} ox_nearest;

#define OX_NONE 0xffffffffu

static ox_nearest ox_trace(__global const ox_mesh* mesh, __global const ox_node* all_nodes,
                           __global const ox_triangle* triangles, float3 origin, float3 direction,
                           float epsilon, float t_max) {
  ox_nearest nearest;
  nearest.back_t = INFINITY;
  nearest.front_t = INFINITY;
  nearest.back = OX_NONE;
  nearest.touching = OX_NONE;
  nearest.entered = false;
  const ox_cast cast = ox_cast_from(origin, direction);
  __global const ox_node* nodes = all_nodes + mesh->node_first;
  float limit = t_max;

  for (uint n = 0u; n < mesh->node_count;) {
    __global const ox_node* node = nodes + n;
    const float3 t_lo = (vload3(0, node->lo) - origin) * cast.inverse;
    const float3 t_hi = (vload3(0, node->hi) - origin) * cast.inverse;
    const float enter = ox_max(ox_max(ox_min(t_lo.x, t_hi.x), ox_min(t_lo.y, t_hi.y)),
                               ox_max(ox_min(t_lo.z, t_hi.z), -epsilon));
    const float leave = ox_min(ox_min(ox_max(t_lo.x, t_hi.x), ox_max(t_lo.y, t_hi.y)),
                               ox_min(ox_max(t_lo.z, t_hi.z), limit));
    if (enter > leave) {
      n = node->skip;
      continue;
    }
    const uint first = mesh->triangle_first + (node->leaf >> 3);
    const uint count = node->leaf & 7u;
    for (uint k = first; k < first + count; ++k) {
      __global const ox_triangle* triangle = triangles + k;
      float t;
      bool back;
      if (!ox_meets(&cast, vload3(0, triangle->a), vload3(0, triangle->b), vload3(0, triangle->c),
                    &t, &back))
        continue;
      if (t < -epsilon) continue;
      if (t <= epsilon) {
        // The vertex lies on this face: an entry does not count, an exit is a touch. epsilon is the
        // worst that rounding can do, a quarter of it already rare: what is farther outside than
        // that does not touch.
        if (!back)
          nearest.entered = true;
        else if (t >= -0.25f * epsilon &&
                 (nearest.touching == OX_NONE || triangle->id < triangles[nearest.touching].id))
          nearest.touching = k;
      } else if (!back) {
        nearest.front_t = ox_min(nearest.front_t, t);
      } else if (t < nearest.back_t ||
                 (t == nearest.back_t && triangle->id < triangles[nearest.back].id)) {
        nearest.back_t = t;
        nearest.back = k;
      }
    }
    // Within epsilon of the nearest hit another may decide what the nearest means.
    limit = ox_min(t_max, ox_min(nearest.front_t, nearest.back_t) + epsilon);
    ++n;
  }
  return nearest;
}

// A front and a back face at one distance: the ray grazes a ridge from outside, or leaves and
// enters again in a valley from inside.
static bool ox_grazes(const ox_nearest* nearest, float epsilon) {
  return nearest->back != OX_NONE && fabs(nearest->back_t - nearest->front_t) <= epsilon;
}

// Whether a vertex whose ray grazes is inside a closed target, by rays in other directions, no two
// of which graze but by a coincidence. Undecided after three: outside.
static bool ox_is_inside(__global const ox_mesh* mesh, __global const ox_node* nodes,
                         __global const ox_triangle* triangles, float3 origin, float epsilon) {
  for (uint k = 0u; k < 3u; ++k) {
    const float3 direction = k == 0u   ? (float3)(0.5481f, 0.3027f, 0.7797f)
                             : k == 1u ? (float3)(-0.2379f, 0.8711f, -0.4297f)
                                       : (float3)(0.3319f, -0.6203f, -0.7107f);
    const ox_nearest nearest =
        ox_trace(mesh, nodes, triangles, origin, direction, epsilon, INFINITY);
    if (!ox_grazes(&nearest, epsilon)) return nearest.back_t < nearest.front_t;
  }
  return false;
}

__kernel void ray_step(__global volatile uint* counters, __global const ox_ray* rays,
                       uint ray_capacity, __global const ox_pair* pairs,
                       __global const ox_mesh* meshes, __global const ox_vertex* vertices,
                       __global const ox_node* nodes, __global const ox_triangle* triangles,
                       __global volatile uint* pair_hits, __global ox_hit* hits, uint capacity) {
  const uint ray_count = min(counters[OX_COUNTER_RAYS * OX_COUNTER_STRIDE], ray_capacity);
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < ray_count; i += stride) {
    const uint pair_side = rays[i].pair_side;
    __global const ox_pair* pair = pairs + (pair_side >> 1);
    const uint side = pair_side & 1u;
    __global const ox_mesh* target = meshes + pair->mesh[1u - side];
    __global const ox_vertex* vertex = vertices + rays[i].vertex;
    const float epsilon = pair->epsilon;
    const float3 origin = ox_place(pair, side, vload3(0, vertex->position));
    const float3 direction = ox_turn(pair, side, vload3(0, vertex->direction));
    const bool closed = (target->flags & OX_MESH_CLOSED) != 0u;
    // Against an open target nothing beyond the source's own exit can be told to be inside.
    const float t_max = closed ? INFINITY : vertex->exit + epsilon;

    const ox_nearest nearest =
        ox_trace(target, nodes, triangles, origin, direction, epsilon, t_max);
    bool inside = nearest.back_t < nearest.front_t;
    if (ox_grazes(&nearest, epsilon))
      inside = closed && ox_is_inside(target, nodes, triangles, origin, epsilon);
    // A hit beyond the source's exit counts for proving the vertex inside. On the surface it is
    // not: it may be the far side of a plate thinner than epsilon.
    const bool within_exit = nearest.back_t <= vertex->exit + epsilon;
    if (nearest.entered && !within_exit) inside = false;

    uint triangle = nearest.back;
    uint kind = OX_HIT_TOUCHING;
    float t = 0.0f;
    float depth = 0.0f;
    if (inside) {
      t = nearest.back_t;
      kind = within_exit ? OX_HIT_INSIDE : OX_HIT_FALLBACK;
      depth = t * ox_max(ox_dot(direction, vload3(0, triangles[triangle].normal)), 0.0f);
    } else if (nearest.touching != OX_NONE) {
      triangle = nearest.touching;
    } else {
      continue;
    }
    const uint slot = atomic_inc(counters + OX_COUNTER_HITS * OX_COUNTER_STRIDE);
    if (slot >= capacity) continue;
    __global ox_hit* hit = hits + slot;
    hit->pair_side = pair_side;
    hit->vertex = rays[i].vertex;
    hit->triangle = triangle;
    hit->kind = kind;
    hit->depth = depth;
    hit->t = t;
    hit->slot = atomic_inc(pair_hits + (pair_side >> 1));
  }
}
