// SPDX-License-Identifier: BSD-3-Clause
// What is behind an open mesh, and how far that is known. Device only.
//
// What went through a ground is behind it as deep as it is thick. But that something is behind a
// surface is known no farther off than the surface goes on to all sides; beyond, it may have come
// round its border. There the shorter part of a vertex's ray through its own mesh counts. Else a
// patch that dips into a body would be behind by the far side of that.
#ifndef ODE_EXT_KERNELS_LIB_BORDER_H
#define ODE_EXT_KERNELS_LIB_BORDER_H

#include "lib/closest.h"
#include "lib/scene.h"
#include "lib/transform.h"

// [1] of its area, the least vector area of a ground: its faces are turned from one way by less
// than 45 degrees, as those of hills. That of half of a ball is 0.5, of half of a pipe 0.64.
#define OX_GROUND 0.7f

// Whether an open mesh is the ground of a smaller body. A sheet is neither.
static inline bool ox_is_ground_of(__global const ox_mesh* mesh, __global const ox_mesh* body) {
  return (mesh->flags & OX_MESH_CLOSED) == 0u &&
         ((body->flags | mesh->flags) & OX_MESH_TWO_SIDED) == 0u && body->radius < mesh->radius &&
         mesh->vector_area > OX_GROUND;
}

// Whether a mesh is a body that may be behind another: that is open, and the mesh is a solid, or
// that is its ground. The rim of a bowl of one layer is behind the ground that it is in; the ground
// within the bowl goes on on the other side of it.
static inline bool ox_may_be_behind(__global const ox_mesh* mesh, __global const ox_mesh* other) {
  if ((other->flags & OX_MESH_CLOSED) != 0u) return false;
  return (mesh->flags & OX_MESH_CLOSED) != 0u || ox_is_ground_of(other, mesh);
}

static inline bool ox_is_border(const ox_scene* scene, uint edge) {
  return scene->edges[edge].triangle[1] == OX_NONE;
}

static inline float ox_distance2_to_segment(float3 p, float3 a, float3 b) {
  const float3 along = b - a;
  const float length2 = ox_dot(along, along);
  const float s = length2 > 0.0f ? ox_dot(p - a, along) / length2 : 0.0f;
  const float3 off = p - (a + clamp(s, 0.0f, 1.0f) * along);
  return ox_dot(off, off);
}

// An end of the edge of a crossing, from the base of its mesh on.
static inline float3 ox_vertex_from_base(const ox_scene* scene, __global const ox_edge_crossing* c,
                                         uint end) {
  const uint vertex = scene->edges[c->edge].vertex[end];
  return ox_from_base(scene->pairs + (c->pair_side >> 1), c->pair_side & 1u,
                      vload3(0, scene->vertices[vertex].position));
}

// The stretch of an edge that is inside, from a crossing on to the next or to its end.
static inline float3 ox_end_inside(const ox_scene* scene, uint head,
                                   __global const ox_edge_crossing* c, float3 start,
                                   float3 direction) {
  const bool leaves = c->leaves != 0u;
  float nearest = INFINITY;
  for (uint i = head; i != OX_NONE; i = scene->crossings[i].before) {
    if (scene->crossings[i].edge != c->edge || (scene->crossings[i].leaves != 0u) == leaves)
      continue;
    const float after = leaves ? c->t - scene->crossings[i].t : scene->crossings[i].t - c->t;
    if (after >= 0.0f) nearest = ox_min(nearest, after);
  }
  const float3 end = ox_vertex_from_base(scene, c, leaves ? 0u : 1u);
  return nearest == INFINITY ? end : start + (leaves ? -nearest : nearest) * direction;
}

// Whether the target of a side of a pair goes on for `distance` about a point of it, from its base
// on.
// Of its border what crosses the source is looked at; a target that does not cross it is within it,
// border and all.
static inline bool ox_goes_on(const ox_scene* scene, uint pair_side, float3 p, float distance) {
  const uint pair = pair_side >> 1;
  const uint side = 1u - (pair_side & 1u);  // of the target
  __global const ox_found* found = scene->found + pair;
  if (found->head[0] == OX_NONE && found->head[1] == OX_NONE) return false;
  if (distance > scene->meshes[scene->pairs[pair].mesh[side]].radius) return false;
  if (found->at_border[side] == 0u) return true;
  for (uint i = found->head[side]; i != OX_NONE; i = scene->crossings[i].before) {
    __global const ox_edge_crossing* c = scene->crossings + i;
    if (!ox_is_border(scene, c->edge)) continue;
    const float3 from = ox_vertex_from_base(scene, c, 0u);
    const float3 along = ox_vertex_from_base(scene, c, 1u) - from;
    const float length = sqrt(ox_dot(along, along));
    const float3 direction = length > 0.0f ? along / length : along;
    const float3 start = from + c->t * direction;
    // As mostly: the crossing itself is near, or not even the rest of the edge is.
    if (ox_distance2_to_segment(p, start, start) < distance * distance) return false;
    const float3 last = ox_vertex_from_base(scene, c, c->leaves != 0u ? 0u : 1u);
    if (ox_distance2_to_segment(p, start, last) >= distance * distance) continue;
    const float3 end = ox_end_inside(scene, found->head[side], c, start, direction);
    if (ox_distance2_to_segment(p, start, end) < distance * distance) return false;
  }
  return true;
}

// Whether a point is beyond a side of a triangle that is of the border of its mesh.
static inline bool ox_is_beyond_border(const ox_scene* scene, __global const ox_triangle* t,
                                       float3 p) {
  const float3 corners[3] = {vload3(0, t->a), vload3(0, t->b), vload3(0, t->c)};
  const uint sides[3] = {t->side_ab, t->side_bc, t->side_ca};
  for (uint k = 0u; k < 3u; ++k) {
    const float3 along = corners[(k + 1u) % 3u] - corners[k];
    const bool is_border = (sides[k] & OX_WITHIN_FACET) == 0u && ox_is_border(scene, sides[k]);
    if (is_border && ox_dot(ox_plain_cross(along, p - corners[k]), vload3(0, t->normal)) < 0.0f)
      return true;
  }
  return false;
}

// The closest triangle of the target of a side of a pair, which is open, if a point, from its base
// on in its frame, is known to be behind that; else OX_NONE. It is where no border crosses the
// source, and the point is neither beyond the border nor farther off than the target is large.
static inline uint ox_closest_in_front(const ox_scene* scene, uint pair_side, float3 p) {
  __global const ox_pair* pair = scene->pairs + (pair_side >> 1);
  const uint side = 1u - (pair_side & 1u);
  if (scene->found[pair_side >> 1].at_border[side] != 0u) return OX_NONE;
  __global const ox_mesh* target = scene->meshes + pair->mesh[side];
  const float3 base = ox_base(pair, side);
  const uint closest =
      ox_closest_triangle(&scene->surfaces, target, base, p, target->radius, pair->epsilon);
  if (closest == OX_NONE) return OX_NONE;
  __global const ox_triangle* t = scene->surfaces.triangles + closest;
  const bool is_within = !ox_is_beyond_border(scene, t, p + base);
  return is_within && ox_is_behind(t, base, p, 0.0f) ? closest : OX_NONE;
}

#endif
