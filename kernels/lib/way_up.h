// SPDX-License-Identifier: BSD-3-Clause
// How deep vertices of a body are behind an open mesh, along the mean normal of the faces that its
// edges cross, and whether their rays tell. Device only.
#ifndef ODE_EXT_KERNELS_LIB_WAY_UP_H
#define ODE_EXT_KERNELS_LIB_WAY_UP_H

#include "lib/border.h"
#include "lib/scene.h"
#include "lib/transform.h"

// In the frame of the body.
typedef struct {
  float3 up;     // unit
  float height;  // [m] along it, of the highest crossing; -INFINITY: there is no way
} ox_way_up;

// The normal of a triangle in whole numbers: crossings come in any order, which the sum of their
// normals does not depend on then.
#define OX_WHOLE_NORMAL 256.0f
static inline int3 ox_whole_normal(const ox_scene* scene, uint triangle) {
  return convert_int3_rte(OX_WHOLE_NORMAL * vload3(0, scene->surfaces.triangles[triangle].normal));
}

// Of the source of a side of a pair.
static inline ox_way_up ox_find_way_up(const ox_scene* scene, uint pair_side) {
  ox_way_up way = {(float3)(0.0f), -INFINITY};
  __global const ox_pair* pair = scene->pairs + (pair_side >> 1);
  const uint side = pair_side & 1u;
  if (!ox_may_be_behind(scene->meshes + pair->mesh[side], scene->meshes + pair->mesh[1u - side]))
    return way;
  const uint head = scene->found[pair_side >> 1].head[side];
  int3 sum = (int3)(0);
  for (uint c = head; c != OX_NONE; c = scene->crossings[c].before)
    sum += ox_whole_normal(scene, scene->crossings[c].triangle);
  const float3 up = ox_rotate(pair, 1u - side, convert_float3(sum));
  const float length = sqrt(ox_dot(up, up));
  if (length == 0.0f) return way;
  way.up = up / length;
  for (uint c = head; c != OX_NONE; c = scene->crossings[c].before) {
    __global const ox_edge* edge = scene->edges + scene->crossings[c].edge;
    const float3 from = vload3(0, scene->vertices[edge->vertex[0]].position);
    const float3 along = vload3(0, scene->vertices[edge->vertex[1]].position) - from;
    const float part = scene->crossings[c].t / sqrt(ox_dot(along, along));
    way.height = ox_max(way.height, ox_dot(from + part * along, way.up));
  }
  return way;
}

// [m] how deep a vertex is below the highest crossing.
static inline float ox_depth_below(const ox_scene* scene, uint index, const ox_way_up* way) {
  return way->height - ox_dot(vload3(0, scene->vertices[index].position), way->up);
}

// Whether the ray of a vertex, which goes as far as its own mesh is thick, gets above the highest
// crossing. Of one that never leaves, as parts of a mesh overlap, it is not known.
static inline bool ox_ray_gets_above(const ox_scene* scene, uint index, const ox_way_up* way) {
  __global const ox_vertex* vertex = scene->vertices + index;
  const float rise = vertex->exit * ox_dot(vload3(0, vertex->direction), way->up);
  return rise < INFINITY && rise >= ox_depth_below(scene, index, way);
}

#endif
