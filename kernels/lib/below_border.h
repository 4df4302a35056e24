// SPDX-License-Identifier: BSD-3-Clause
// Where the edges of a vertex come from below an open mesh that it is beyond the border of. Device
// only.
//
// A rod that dips under the border of a tile goes on below the next one: its end is behind neither.
// What of it is behind the tile reaches to where the tile ends, and is the deepest there. No border
// is in the rod, which is all below it, to tell that.
#ifndef ODE_EXT_KERNELS_LIB_BELOW_BORDER_H
#define ODE_EXT_KERNELS_LIB_BELOW_BORDER_H

#include "lib/border.h"

// The place on an edge of the vertex, and the triangle that it is below.
typedef struct {
  uint edge;  // OX_NONE: none is below
  uint triangle;
  float t;      // [m] from the vertex
  float depth;  // [m]
} ox_below_border;

// From where on a segment is on the inner side of each side of a triangle that is of the border, as
// a share of it, if that is more than `share`; else `share`. `beyond` [m]: so far outside is not.
static inline float ox_pass_border(const ox_scene* scene, __global const ox_triangle* t,
                                   float3 base, float3 from, float3 to, float beyond, float share) {
  const float3 corners[3] = {vload3(0, t->a) - base, vload3(0, t->b) - base,
                             vload3(0, t->c) - base};
  const uint sides[3] = {t->side_ab, t->side_bc, t->side_ca};
  const float3 normal = vload3(0, t->normal);
  float passed = share;
  for (uint k = 0u; k < 3u; ++k) {
    if ((sides[k] & OX_WITHIN_FACET) != 0u || !ox_is_border(scene, sides[k])) continue;
    const float3 along = corners[(k + 1u) % 3u] - corners[k];
    const float length = sqrt(ox_dot(along, along));
    const float one = ox_dot(ox_plain_cross(along, from - corners[k]), normal) / length;
    const float other = ox_dot(ox_plain_cross(along, to - corners[k]), normal) / length;
    if (one + share * (other - one) < -beyond)
      passed = other > one ? ox_max(passed, -one / (other - one)) : INFINITY;
  }
  return passed;
}

// On the edge of two points, from the base of the target on, that begins beyond the border of it;
// `closest` to its first point is this triangle.
static inline ox_below_border ox_look_along(const ox_scene* scene, uint pair_side, float3 from,
                                            float3 to, uint closest) {
  __global const ox_pair* pair = scene->pairs + (pair_side >> 1);
  const uint side = 1u - (pair_side & 1u);  // of the target
  __global const ox_mesh* target = scene->meshes + pair->mesh[side];
  const float3 base = ox_base(pair, side);
  ox_below_border below = {OX_NONE, OX_NONE, 0.0f, 0.0f};
  float share = 0.0f;
  while (closest != OX_NONE) {  // a border that turns is passed triangle by triangle
    __global const ox_triangle* t = scene->surfaces.triangles + closest;
    const float passed = ox_pass_border(scene, t, base, from, to, OX_MARGIN * pair->epsilon, share);
    if (!(passed <= 1.0f)) break;
    const float3 p = from + passed * (to - from);
    if (passed > share) {
      share = passed;
      closest =
          ox_closest_triangle(&scene->surfaces, target, base, p, target->radius, pair->epsilon);
      continue;
    }
    below.depth = ox_dot(vload3(0, t->normal), vload3(0, t->a) - base - p);
    if (share > 0.0f && below.depth > 0.0f) below.triangle = closest;
    below.t = share * sqrt(ox_dot(to - from, to - from));
    break;
  }
  return below;
}

// Of the edges at a vertex of a solid, which a crossing tells to be behind the open target of a
// side of a pair, and which is beyond its border, the one that is the deepest where it comes from
// below that. Where the border crosses the solid, it tells by itself (contacts/behind_border.h).
static inline ox_below_border ox_find_below_border(const ox_scene* scene, uint pair_side,
                                                   uint vertex) {
  __global const ox_pair* pair = scene->pairs + (pair_side >> 1);
  const uint side = pair_side & 1u;
  const float3 from = ox_place(pair, side, vload3(0, scene->vertices[vertex].position));
  ox_below_border best = {OX_NONE, OX_NONE, 0.0f, 0.0f};
  if (scene->found[pair_side >> 1].at_border[1u - side] != 0u) return best;
  __global const ox_mesh* target = scene->meshes + pair->mesh[1u - side];
  const float3 base = ox_base(pair, 1u - side);
  const uint closest =
      ox_closest_triangle(&scene->surfaces, target, base, from, target->radius, pair->epsilon);
  if (closest == OX_NONE ||
      !ox_is_beyond_border(scene, scene->surfaces.triangles + closest, from + base))
    return best;
  for (uint k = scene->ring_starts[vertex]; k < scene->ring_starts[vertex + 1u]; ++k) {
    const ox_neighbour neighbour = scene->rings[k];
    const float3 to = ox_place(pair, side, vload3(0, scene->vertices[neighbour.vertex].position));
    ox_below_border below = ox_look_along(scene, pair_side, from, to, closest);
    if (below.triangle == OX_NONE || !(below.depth > best.depth)) continue;
    best = below;
    best.edge = neighbour.edge;
  }
  return best;
}

#endif
