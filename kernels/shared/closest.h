// SPDX-License-Identifier: BSD-3-Clause
// The triangle of a mesh that is closest to a point. Device only.
#ifndef ODE_EXT_KERNELS_SHARED_CLOSEST_H
#define ODE_EXT_KERNELS_SHARED_CLOSEST_H

#include "shared/meshlet_tree.h"
#include "shared/scene.h"

static inline float ox_distance2_to_line(float3 p, float3 a, float3 b) {
  const float3 d = b - a;
  const float length2 = ox_dot(d, d);
  const float t = length2 > 0.0f ? clamp(ox_dot(p - a, d) / length2, 0.0f, 1.0f) : 0.0f;
  const float3 off = p - (a + t * d);
  return ox_dot(off, off);
}

// To its plane where the point is over it, else to the nearest of its edges.
static inline float ox_distance2_to_triangle(float3 p, __global const ox_triangle* t) {
  const float3 a = vload3(0, t->a);
  const float3 b = vload3(0, t->b);
  const float3 c = vload3(0, t->c);
  const float3 n = vload3(0, t->normal);
  if (ox_dot(ox_plain_cross(b - a, p - a), n) >= 0.0f &&
      ox_dot(ox_plain_cross(c - b, p - b), n) >= 0.0f &&
      ox_dot(ox_plain_cross(a - c, p - c), n) >= 0.0f) {
    const float height = ox_dot(p - a, n);
    return height * height;
  }
  return ox_min(ox_distance2_to_line(p, a, b),
                ox_min(ox_distance2_to_line(p, b, c), ox_distance2_to_line(p, c, a)));
}

// Within `bound` [m]; OX_NONE: none is. Ties go by the index.
static inline uint ox_closest_triangle(const ox_surfaces* surfaces, __global const ox_mesh* mesh,
                                       float3 p, float bound) {
  uint closest = OX_NONE;
  float closest2 = bound * bound;
  ox_box_walk walk = ox_begin_box_walk(mesh);
  while (walk.count != 0u) {
    const uint child = walk.child[--walk.count];
    if ((child & OX_CHILD_MESHLET) != 0u) {
      __global const ox_meshlet* m = surfaces->meshlets + mesh->meshlet_first + (child >> 1);
      for (uint k = 0u; k < m->triangle_count; ++k) {
        const uint triangle = m->triangle_first + k;
        __global const ox_triangle* t = surfaces->triangles + triangle;
        const float3 n = vload3(0, t->normal);
        if (ox_dot(n, n) == 0.0f) continue;  // of no area
        const float distance2 = ox_distance2_to_triangle(p, t);
        if (!(distance2 <= closest2) || (distance2 == closest2 && triangle > closest)) continue;
        closest = triangle;
        closest2 = distance2;
      }
      continue;
    }
    __global const ox_meshlet_node* node =
        surfaces->nodes + mesh->meshlet_node_first + (child >> 1);
    for (uint k = 0u; k < node->count; ++k) {
      const float3 lo = (float3)(node->lo[0][k], node->lo[1][k], node->lo[2][k]);
      const float3 hi = (float3)(node->hi[0][k], node->hi[1][k], node->hi[2][k]);
      const float3 off = fmax(fmax(lo - p, p - hi), 0.0f);
      if (ox_dot(off, off) <= closest2) walk.child[walk.count++] = node->child[k];
    }
  }
  return closest;
}

#endif
