// SPDX-License-Identifier: BSD-3-Clause
// On which side of a sheet a smaller mesh is. Device only.
//
// A sheet has no front. Where the normals of its faces that the other mesh crosses are about the
// same on the mean, and the middle of that mesh is farther along them than all crossings, or less
// far than all, it is on that side, and what of it is on the other has gone through. Else each way
// through it tells by itself, as in a bag, between two layers, or where a sheet hangs into a bowl.
// Of a mesh that is larger, as a ground, the middle may be far from the sheet and tells nothing;
// nor does it where the sheet ends in the other mesh.
#ifndef ODE_EXT_KERNELS_LIB_SHEET_SIDE_H
#define ODE_EXT_KERNELS_LIB_SHEET_SIDE_H

#include "lib/border.h"
#include "lib/scene.h"
#include "lib/transform.h"
#include "lib/way_up.h"

// The sheet of a pair, by its side; OX_NONE: there is none, or both are.
static inline uint ox_sheet_of(const ox_scene* scene, __global const ox_pair* pair) {
  const bool is_sheet[2] = {(scene->meshes[pair->mesh[0]].flags & OX_MESH_TWO_SIDED) != 0u,
                            (scene->meshes[pair->mesh[1]].flags & OX_MESH_TWO_SIDED) != 0u};
  if (is_sheet[0] == is_sheet[1]) return OX_NONE;
  return is_sheet[0] ? 0u : 1u;
}

// The face of the sheet at a crossing, and where that is, from the base of the sheet on.
static inline uint ox_sheet_face(const ox_scene* scene, __global const ox_edge_crossing* c,
                                 uint sheet) {
  return (c->pair_side & 1u) == sheet ? scene->edges[c->edge].triangle[0] : c->triangle;
}

static inline float3 ox_place_at_sheet(const ox_scene* scene, __global const ox_edge_crossing* c,
                                       uint sheet) {
  const float3 from = ox_vertex_from_base(scene, c, 0u);
  const float3 along = ox_vertex_from_base(scene, c, 1u) - from;
  const float length = sqrt(ox_dot(along, along));
  const float3 p = from + (length > 0.0f ? c->t / length : 0.0f) * along;
  const uint side = c->pair_side & 1u;
  return side == sheet ? p : ox_transform_from_base(scene->pairs + (c->pair_side >> 1), side, p);
}

// OX_SHEET_...
static inline uint ox_find_sheet_side(const ox_scene* scene, uint p, uint sheet) {
  __global const ox_pair* pair = scene->pairs + p;
  const uint body = 1u - sheet;
  __global const ox_mesh* mesh = scene->meshes + pair->mesh[body];
  if (mesh->radius >= scene->meshes[pair->mesh[sheet]].radius ||
      scene->found[p].at_border[sheet] != 0u)
    return OX_SHEET_UNTOLD;
  int3 sum = (int3)(0);
  uint count = 0u;
  for (uint side = 0u; side < 2u; ++side)
    for (uint i = scene->found[p].head[side]; i != OX_NONE; i = scene->crossings[i].before) {
      sum += ox_whole_normal(scene, ox_sheet_face(scene, scene->crossings + i, sheet));
      ++count;
    }
  const float3 up = convert_float3(sum);
  const float length = sqrt(ox_dot(up, up));
  if (count == 0u || length < OX_GROUND * OX_WHOLE_NORMAL * (float)count) return OX_SHEET_UNTOLD;
  float lowest = INFINITY;
  float highest = -INFINITY;
  for (uint side = 0u; side < 2u; ++side)
    for (uint i = scene->found[p].head[side]; i != OX_NONE; i = scene->crossings[i].before) {
      const float height = ox_dot(up, ox_place_at_sheet(scene, scene->crossings + i, sheet));
      lowest = ox_min(lowest, height);
      highest = ox_max(highest, height);
    }
  const float height = ox_dot(up, ox_place(pair, body, vload3(0, mesh->box_centre)));
  if (height > highest) return OX_SHEET_FRONT;
  return height < lowest ? OX_SHEET_BACK : OX_SHEET_UNTOLD;
}

#endif
