// SPDX-License-Identifier: BSD-3-Clause
// Edges cast as segments: every triangle of the target that an edge of the source crosses. Device
// only.
//
// In general position two surfaces intersect exactly where an edge of one crosses a face of the
// other, so what vertex rays miss (edges that meet edges or cut across faces) is found here.
#ifndef ODE_EXT_KERNELS_SHARED_EDGE_RAY_H
#define ODE_EXT_KERNELS_SHARED_EDGE_RAY_H

#include "shared/append.h"
#include "shared/cull.h"
#include "shared/full_ray.h"

// An edge in the frame of the target.
typedef struct {
  float3 from, direction;  // direction: unit
  float length;
} ox_segment;

static inline ox_segment ox_segment_of(__global const ox_pair* pair, uint side,
                                       __global const ox_vertex* vertices,
                                       __global const ox_edge* edge) {
  ox_segment segment;
  segment.from = ox_place(pair, side, vload3(0, vertices[edge->vertex[0]].position));
  const float3 to = ox_place(pair, side, vload3(0, vertices[edge->vertex[1]].position));
  const float3 along = to - segment.from;
  segment.length = sqrt(ox_dot(along, along));
  segment.direction = segment.length > 0.0f ? along / segment.length : (float3)(0.0f);
  return segment;
}

// Whether the edge can cross the surface of the target: by its bounding ball.
static inline bool ox_keep_edge(__global const ox_pair* pair, uint side,
                                __global const ox_mesh* meshes, __global const ox_edge* edge,
                                __global const uint* grids) {
  if (edge->radius < 0.0f) return false;
  __global const ox_mesh* target = meshes + pair->mesh[1u - side];
  const float radius = edge->radius + pair->epsilon;
  const float3 middle = ox_place(pair, side, vload3(0, edge->middle));
  const float3 d = fabs(middle - vload3(0, target->box_centre));
  const float3 limit = vload3(0, target->box_half) + radius;
  if (d.x > limit.x || d.y > limit.y || d.z > limit.z) return false;
  return ox_may_near_surface(target, grids, middle, radius);
}

// Every place where the segment crosses the target, a little beyond its ends too: edges that meet
// in a vertex are cast one by one, and none of them may leave it to the other.
static inline void ox_cast_edge(__global volatile uint* counters, __global const ox_list* lists,
                                uint pair_side, uint edge_index, __global const ox_pair* pairs,
                                __global const ox_mesh* meshes, __global const ox_vertex* vertices,
                                __global const ox_edge* edges, __global const ox_node* all_nodes,
                                __global const ox_triangle* triangles,
                                __global volatile uint* pair_crossings,
                                __global ox_edge_crossing* crossings, uint* work) {
  __global const ox_pair* pair = pairs + (pair_side >> 1);
  const uint side = pair_side & 1u;
  __global const ox_mesh* target = meshes + pair->mesh[1u - side];
  const ox_segment segment = ox_segment_of(pair, side, vertices, edges + edge_index);
  if (segment.length == 0.0f) return;
  const float from = -pair->epsilon;
  const float limit = segment.length + pair->epsilon;
  const ox_cast cast = ox_cast_from(segment.from, segment.direction);
  __global const ox_node* nodes = all_nodes + target->node_first;
  for (uint n = 0u; n < target->node_count;) {
    __global const ox_node* node = nodes + n;
    *work += OX_WORK_NODE;
    if (!ox_meets_box(&cast, node, from, limit)) {
      n = node->skip;
      continue;
    }
    const uint first = target->triangle_first + (node->leaf >> 3);
    const uint count = node->leaf & 7u;
    *work += count * OX_WORK_TRIANGLE;
    for (uint k = first; k < first + count; ++k) {
      __global const ox_triangle* triangle = triangles + k;
      float t;
      bool back;
      if (!ox_meets(&cast, vload3(0, triangle->a), vload3(0, triangle->b), vload3(0, triangle->c),
                    &t, &back) ||
          !(t >= from && t <= limit))
        continue;
      const uint slot = ox_append(counters, lists, OX_LIST_CROSSINGS);
      if (slot == OX_NONE) continue;
      __global ox_edge_crossing* crossing = crossings + slot;
      crossing->pair_side = pair_side;
      crossing->edge = edge_index;
      crossing->triangle = k;
      crossing->t = t;
      crossing->leaves = back ? 1u : 0u;
      crossing->slot = atomic_inc(pair_crossings + (pair_side >> 1));
    }
    ++n;
  }
}

// The edge of a place in a task; OX_NONE: there is none, or it cannot cross the target.
static inline uint ox_choose_edge(__global const ox_chunk_task* task, uint lane,
                                  __global const ox_pair* pairs, __global const ox_mesh* meshes,
                                  __global const ox_chunk* chunks, __global const ox_edge* edges,
                                  __global const uint* grids, uint* work) {
  *work += 1u;
  if (task->chunk == OX_NONE) return OX_NONE;
  __global const ox_chunk* chunk = chunks + task->chunk;
  if (lane >= chunk->count) return OX_NONE;
  const uint edge = chunk->first + lane;
  *work += 2u;
  return ox_keep_edge(pairs + (task->pair_side >> 1), task->pair_side & 1u, meshes, edges + edge,
                      grids)
             ? edge
             : OX_NONE;
}

#endif
