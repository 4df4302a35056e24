// SPDX-License-Identifier: BSD-3-Clause
// Vertices whose ray leaves the target through an edge of it. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_EXIT_EDGE_H
#define ODE_EXT_KERNELS_SHARED_EXIT_EDGE_H

#include "shared/way_out.h"

// More triangles about a corner are not looked at.
#define OX_MOST_AROUND 16u

// The triangle across an edge that passes within epsilon of a point on `triangle`, other than the
// one across which `from` lies; OX_NONE: there is none. All indices over all meshes.
static inline uint ox_next_around(const ox_edge_pair* p, uint mesh, uint triangle, uint from,
                                  float3 point) {
  __global const ox_triangle* t = p->surfaces.triangles + triangle;
  const float epsilon = p->pair->epsilon;
  for (uint k = 0u; k < 3u; ++k) {
    const uint across = k == 0u ? t->across_ab : k == 1u ? t->across_bc : t->across_ca;
    if (across == OX_NONE || p->mesh[mesh]->triangle_first + across == from) continue;
    float3 a = vload3(0, k == 0u ? t->a : k == 1u ? t->b : t->c);
    float3 b = vload3(0, k == 0u ? t->b : k == 1u ? t->c : t->a);
    if (mesh == 0u) {
      a = ox_place(p->pair, 0u, a);
      b = ox_place(p->pair, 0u, b);
    }
    // Squares of lengths, no more: their products would over- and underflow (geometry/range.h).
    const float3 along = (b - a) / sqrt(ox_dot(b - a, b - a));
    const float3 off = ox_plain_cross(point - a, along);
    if (ox_dot(off, off) <= epsilon * epsilon) return p->mesh[mesh]->triangle_first + across;
  }
  return OX_NONE;
}

// A ray through an edge or a corner of the target, to within epsilon, leaves it by all the faces
// there; which of them it was found to meet is rounding's choice. The way out is the one that is
// least deep. (Boxes that share an edge, the corners of one aiming at it from within the other,
// would have to part across their whole width.)
static inline void ox_choose_exits(const ox_edge_pair* p) {
  for (uint i = 0u; i < p->candidate_count; ++i) {
    __global ox_candidate* c = p->candidates + i;
    const uint side = (c->side_kind & OX_HIT_SIDE) != 0u ? 1u : 0u;
    if ((c->side_kind & OX_HIT_KIND) != OX_HIT_INSIDE ||
        (p->mesh[1u - side]->flags & OX_MESH_CLOSED) == 0u)
      continue;
    const float3 position = vload3(0, c->position);
    float3 direction = vload3(0, p->vertices[c->vertex].direction);
    if (side == 0u) direction = ox_turn(p->pair, 0u, direction);
    const float3 exit = position + c->t * direction;
    const uint first = c->triangle;
    uint from = OX_NONE;
    uint triangle = first;
    for (uint k = 0u; k < OX_MOST_AROUND; ++k) {
      const uint next = ox_next_around(p, 1u - side, triangle, from, exit);
      if (next == OX_NONE || next == first) break;
      from = triangle;
      triangle = next;
      const ox_way_out way = ox_through(p, side, triangle);
      const float depth = ox_depth_below(&way, position);
      // As for touches, a ray along a face does not leave by it (ox_leaves_by).
      if (ox_dot(direction, way.normal) <= 0.1f || !(depth < c->depth - p->pair->epsilon)) continue;
      c->triangle = triangle;
      c->depth = depth;
      vstore3(side == 0u ? way.normal : -way.normal, 0, c->normal);
    }
  }
}

#endif
#endif
