// SPDX-License-Identifier: BSD-3-Clause
// Edges of which all is inside the other mesh. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_WHOLE_EDGE_H
#define ODE_EXT_KERNELS_CONTACTS_WHOLE_EDGE_H

#include "contacts/feature_table.h"
#include "contacts/units.h"

// The feature that is the other end of an edge from a vertex of mesh `side` that is inside;
// OX_NONE: not all of the edge is, or it is within a facet and bounds nothing.
static inline uint ox_other_end_inside(const ox_region_view* r, uint side, uint vertex, uint edge) {
  const ox_scene* scene = r->scene;
  if (ox_is_flat_edge(ox_mesh_of(scene, scene->pairs + r->pair, side), edge)) return OX_NONE;
  __global const uint* ends = scene->edges[edge].vertex;
  const uint other = ends[0] == vertex ? ends[1] : ends[0];
  const uint entry = ox_find_feature(scene, ox_inside_key(r->pair, side, other));
  if (entry == OX_NONE || ox_find_feature(scene, ox_edge_key(r->pair, side, edge)) != OX_NONE)
    return OX_NONE;
  return entry >> 2;
}

// Where a vertex leaves by a plane, and the other end of an edge that is all inside as soon the
// other way, as the ends of a box do that is as long as the step it is pressed into is wide, the
// edge goes neither way: the unit becomes all of it. Returns whether it does.
static inline bool ox_take_whole_edge(const ox_region_view* r, uint unit,
                                      const ox_plane_choice* choice) {
  const ox_scene* scene = r->scene;
  const uint side = ox_side_of(ox_flags_of(r, unit));
  __global const ox_feature* f = ox_feature_of(r, unit);
  if (!ox_is_vertex(f->flags) || (ox_target_of(r, side)->flags & OX_MESH_CLOSED) == 0u)
    return false;
  const uint vertex = f->source;
  const float3 back = -ox_way_of(side, choice->plane.normal);
  const float soon = OX_WORTH * (choice->depth + OX_CLEARANCE * scene->pairs[r->pair].epsilon);
  for (uint i = scene->ring_starts[vertex]; i < scene->ring_starts[vertex + 1u]; ++i) {
    const uint end = ox_other_end_inside(r, side, vertex, scene->rings[i].edge);
    if (end == OX_NONE) continue;
    const float3 p = vload3(0, scene->features[end].position);
    if (ox_plane_depth(&choice->plane, side, p) <= soon) continue;
    const ox_plane other = ox_face_along(r, side, 0.5f * (vload3(0, f->position) + p), back);
    if (other.kind == OX_PLANE_NONE || ox_plane_depth(&other, side, p) > soon) continue;
    if (ox_is_first_item()) ox_set_vector(&r->members, OX_MEMBER_END, unit, p);
    ox_settle();
    return true;
  }
  return false;
}

#endif
