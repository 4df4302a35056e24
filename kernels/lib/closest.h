// SPDX-License-Identifier: BSD-3-Clause
// The triangle of a mesh that is nearest to a point, all of a meshlet asked at a time. Device only.
#ifndef ODE_EXT_KERNELS_LIB_CLOSEST_H
#define ODE_EXT_KERNELS_LIB_CLOSEST_H

#include "lib/corners.h"
#include "lib/general_position.h"
#include "lib/meshlet_tree.h"
#include "lib/scene.h"

static inline void ox_dot_lanes(const ox_points* a, const ox_points* b, ox_floats* product) {
  *product = a->x * b->x + a->y * b->y + a->z * b->z;
}

static inline void ox_cross_lanes(const ox_points* a, const ox_points* b, ox_points* product) {
  product->x = a->y * b->z - a->z * b->y;
  product->y = a->z * b->x - a->x * b->z;
  product->z = a->x * b->y - a->y * b->x;
}

// Squared, from a point to the side of each triangle that goes from a corner, both as seen from the
// point, the lesser of that and what was there; and whether the point is on the inner side of it.
static inline void ox_note_side(const ox_points* from, const ox_points* to, const ox_points* normal,
                                ox_floats* distance2, ox_ints* within) {
  const ox_points along = {to->x - from->x, to->y - from->y, to->z - from->z};
  ox_floats length2, before, turn, off2;
  ox_dot_lanes(&along, &along, &length2);
  ox_dot_lanes(&along, from, &before);
  const ox_floats zero = (ox_floats)(0.0f);
  ox_floats t = length2 > 0.0f ? -before / length2 : zero;
  t = OX_GREATER(t, zero);
  t = OX_LESSER(t, zero + 1.0f);
  const ox_points off = {from->x + t * along.x, from->y + t * along.y, from->z + t * along.z};
  ox_dot_lanes(&off, &off, &off2);
  *distance2 = OX_LESSER(off2, *distance2);
  ox_points across;
  ox_cross_lanes(from, &along, &across);
  ox_dot_lanes(&across, normal, &turn);
  *within &= turn >= 0.0f;
}

// A power of two by which lengths about a mesh are to be multiplied, so that products of six of
// them neither overflow nor underflow: the reciprocal of its extent, rounded to one.
static inline float ox_unit_scale(__global const ox_mesh* mesh) {
  return as_float(0x7f000000u - (as_uint(mesh->extent) & 0x7f800000u));
}

// The vertices of a meshlet as seen from a point, from `base` on, all lengths times `scale`.
static inline void ox_vertices_from(__global const ox_meshlet* m, float3 base, float3 p,
                                    float scale, ox_moved_vertices* seen) {
  for (uint block = 0u; block < OX_BLOCKS; ++block) {
    const ox_points from = {(ox_load(block, m->vertex[0]) - base.x - p.x) * scale,
                            (ox_load(block, m->vertex[1]) - base.y - p.y) * scale,
                            (ox_load(block, m->vertex[2]) - base.z - p.z) * scale};
    ox_set_vertices(seen, block, &from);
  }
}

// From a point to the triangles of a block of a meshlet, and to their planes, squared; infinite
// where one is of no area, where the point is farther in front of one than `before2`, squared, and
// where it is farther from the plane than `near2`: no triangle is nearer than its plane.
static inline void ox_distances2(__global const ox_meshlet* m, const ox_moved_vertices* seen,
                                 uint block, float before2, float near2, ox_floats* distance2,
                                 ox_floats* height2) {
  ox_points corner[3];
  for (uint k = 0u; k < 3u; ++k) ox_corners_of(m, seen, block, k, corner + k);
  const ox_points ab = {corner[1].x - corner[0].x, corner[1].y - corner[0].y,
                        corner[1].z - corner[0].z};
  const ox_points ac = {corner[2].x - corner[0].x, corner[2].y - corner[0].y,
                        corner[2].z - corner[0].z};
  ox_points normal;
  ox_cross_lanes(&ab, &ac, &normal);
  ox_floats area2, height;
  ox_dot_lanes(&normal, &normal, &area2);
  ox_dot_lanes(&normal, corner, &height);
  *height2 = height * height / area2;
  *distance2 = (ox_floats)(INFINITY);
  const ox_ints counts =
      (area2 > 0.0f) & ((height > 0.0f) | (*height2 <= before2)) & (*height2 <= near2);
  if (ox_mask_of(&counts) == 0u) return;
  ox_ints within = counts;
  for (uint k = 0u; k < 3u; ++k)
    ox_note_side(corner + k, corner + (k + 1u) % 3u, &normal, distance2, &within);
  // Rounding may say otherwise of a needle; and the order in which they are met is not to matter.
  *distance2 = within ? *height2 : OX_GREATER(*distance2, *height2);
  *distance2 = counts ? *distance2 : (ox_floats)(INFINITY);
}

// The triangle that is nearest so far; distances are squared and scaled.
typedef struct {
  uint triangle;
  float first2, second2;  // the least distances of all triangles; INFINITY: of none yet
  float tie;              // triangles whose distances differ by no more are as near
  float near2;            // the least or the bound, and the tie: what is farther is not looked at
  float height2;          // to the plane of the triangle
  bool is_least_known;    // of all that are as near, the one that faces the point most is wanted
  float before2;          // so far the point may be in front of it
} ox_closest;

// Of a tie that is not 0 at least what rounding can do to the distance.
static inline float ox_as_near2(float distance2, float tie) {
  const float distance = sqrt(distance2);
  const float near = distance + (tie > 0.0f ? ox_max(tie, OX_ROUNDING * distance) : 0.0f);
  return near * near;
}

// It is within near2. The plane of the one that faces the point most is the farthest.
static inline void ox_note_closest(ox_closest* closest, uint triangle, float distance2,
                                   float height2) {
  if (closest->is_least_known) {
    if (height2 < closest->height2 || (height2 == closest->height2 && triangle > closest->triangle))
      return;
    closest->triangle = triangle;
    closest->height2 = height2;
  } else if (distance2 < closest->first2) {
    closest->triangle = triangle;
    closest->second2 = closest->first2;
    closest->first2 = distance2;
    closest->near2 = OX_LESSER(closest->near2, ox_as_near2(distance2, closest->tie));
  } else {
    closest->second2 = OX_LESSER(closest->second2, distance2);
  }
}

static inline void ox_walk_near(const ox_surfaces* surfaces, __global const ox_mesh* mesh,
                                float3 base, float3 p, float scale, ox_closest* closest) {
  const float3 place = p + base;
  ox_box_walk walk = ox_begin_box_walk(mesh);
  while (walk.count != 0u) {
    const uint child = walk.child[--walk.count];
    if ((child & OX_CHILD_MESHLET) != 0u) {
      __global const ox_meshlet* m = surfaces->meshlets + mesh->meshlet_first + (child >> 1);
      ox_moved_vertices seen;
      ox_vertices_from(m, base, p, scale, &seen);
      for (uint block = 0u; block < OX_BLOCKS; ++block) {
        ox_floats distance2, height2;
        ox_distances2(m, &seen, block, closest->before2, closest->near2, &distance2, &height2);
        const ox_ints is_near = distance2 <= closest->near2;
        uint near = ox_mask_of(&is_near) & ox_lanes_with_area(m, block);
        if (near == 0u) continue;
        ox_lane_floats distance2_of, height2_of;
        ox_keep_lanes(&distance2, &distance2_of);
        ox_keep_lanes(&height2, &height2_of);
        for (; near != 0u; near &= near - 1u) {
          const uint lane = ox_lowest(near);
          ox_note_closest(closest, m->triangle[OX_VECTOR_WIDTH * block + lane],
                          ox_lane(&distance2_of, lane), ox_lane(&height2_of, lane));
        }
      }
      continue;
    }
    __global const ox_meshlet_node* node =
        surfaces->nodes + mesh->meshlet_node_first + (child >> 1);
    ox_best_child best = {OX_NONE, 0.0f};
    for (uint block = 0u; block < OX_BLOCKS; ++block) {
      const ox_floats zero = (ox_floats)(0.0f);
      const ox_points before = {ox_load(block, node->lo[0]) - place.x,
                                ox_load(block, node->lo[1]) - place.y,
                                ox_load(block, node->lo[2]) - place.z};
      const ox_points behind = {place.x - ox_load(block, node->hi[0]),
                                place.y - ox_load(block, node->hi[1]),
                                place.z - ox_load(block, node->hi[2])};
      const ox_points off = {OX_GREATER(OX_GREATER(before.x, behind.x), zero),
                             OX_GREATER(OX_GREATER(before.y, behind.y), zero),
                             OX_GREATER(OX_GREATER(before.z, behind.z), zero)};
      ox_floats distance2;
      ox_dot_lanes(&off, &off, &distance2);
      distance2 *= scale * scale;
      const ox_ints is_near = distance2 <= closest->near2;
      const uint near = ox_mask_of(&is_near) & ox_present_children(node, block);
      const ox_floats nearness = -distance2;
      ox_push_children(node, block, near, &nearness, &walk, &best);
    }
    ox_put_best_last(&walk, &best);
  }
}

// To a point, from `base` on, in the frame of the mesh, within `bound` [m]; OX_NONE: none is. `tie`
// [m]: by how much distances may be off. Where the nearest point is on an edge or a vertex its
// triangles are as near as one another, and neither rounding nor the order in which they are met
// is to say which: so the least distance is found first, and where several are as near they are met
// once more. `before` [m]: of those alone that the point is behind, or no farther in front of.
static inline uint ox_closest_of(const ox_surfaces* surfaces, __global const ox_mesh* mesh,
                                 float3 base, float3 p, float bound, float tie, float before) {
  const float scale = ox_unit_scale(mesh);
  ox_closest closest;
  closest.triangle = OX_NONE;
  closest.first2 = closest.second2 = INFINITY;
  closest.tie = tie * scale;
  closest.near2 = ox_as_near2(bound * scale * bound * scale, closest.tie);
  closest.height2 = -1.0f;
  closest.is_least_known = false;
  closest.before2 = before * scale * before * scale;
  ox_walk_near(surfaces, mesh, base, p, scale, &closest);
  if (closest.second2 <= closest.near2 && closest.first2 < INFINITY) {
    closest.is_least_known = true;
    ox_walk_near(surfaces, mesh, base, p, scale, &closest);
  }
  return closest.triangle;
}

// [m] how far a point, from `base` on, is in front of the plane of a triangle.
static inline float ox_height_over(__global const ox_triangle* triangle, float3 base, float3 p) {
  return ox_dot(vload3(0, triangle->normal), p - (vload3(0, triangle->a) - base));
}

// Whether a point, from `base` on, is behind a triangle, or in front by no more than a margin [m].
static inline bool ox_is_behind(__global const ox_triangle* triangle, float3 base, float3 p,
                                float margin) {
  return ox_height_over(triangle, base, p) <= margin;
}

static inline uint ox_closest_triangle(const ox_surfaces* surfaces, __global const ox_mesh* mesh,
                                       float3 base, float3 p, float bound, float tie) {
  return ox_closest_of(surfaces, mesh, base, p, bound, tie, INFINITY);
}

#endif
