// SPDX-License-Identifier: BSD-3-Clause
// The contact of two edges that cross one another's faces: a separating axis test of the two wedges
// (Gottschalk 1996; Ericson 2005, section 5.2.1, for whole boxes). Frame of B. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_EDGE_AXIS_H
#define ODE_EXT_KERNELS_SHARED_EDGE_AXIS_H

#include "shared/edge_pair.h"

// One of the two edges: its line, the stretch of it inside the other mesh, the faces at it.
typedef struct {
  ox_line line;
  float chord[2];  // [m] along the line
  uint faces;      // one or two, those with an area
  float3 normal[2];
  float3 into[2];  // unit, from the edge into the face, along the face
} ox_wedge;

static inline ox_wedge ox_wedge_of(const ox_edge_pair* p, __global const ox_pair_crossing* c) {
  ox_wedge wedge;
  const uint mesh = ox_side(c);
  wedge.line = ox_line_of(p, mesh, c->edge);
  wedge.chord[0] = ox_min(c->t, c->other_t);
  wedge.chord[1] = ox_max(c->t, c->other_t);
  wedge.faces = 0u;
  __global const ox_edge* edge = p->edges + c->edge;
  for (uint k = 0u; k < 2u; ++k) {
    if (edge->triangle[k] == OX_NONE) continue;
    __global const ox_triangle* triangle = p->surfaces.triangles + edge->triangle[k];
    const float3 normal = ox_normal_in_b(p, mesh, edge->triangle[k]);
    if (ox_dot(normal, normal) == 0.0f) continue;
    // The corner off the edge is the one farthest from its line.
    float3 into = (float3)(0.0f);
    float farthest = 0.0f;
    for (uint corner = 0u; corner < 3u; ++corner) {
      float3 q = vload3(0, corner == 0u ? triangle->a : corner == 1u ? triangle->b : triangle->c);
      if (mesh == 0u) q = ox_place(p->pair, 0u, q);
      const float3 d = q - wedge.line.from;
      const float3 off = d - ox_dot(d, wedge.line.along) * wedge.line.along;
      const float length2 = ox_dot(off, off);
      if (length2 > farthest) {
        farthest = length2;
        into = off;
      }
    }
    if (farthest == 0.0f) continue;
    wedge.normal[wedge.faces] = normal;
    wedge.into[wedge.faces] = into / sqrt(farthest);
    ++wedge.faces;
  }
  return wedge;
}

// Whether all of the wedge near its edge lies behind the plane with normal n through the edge, to
// within 1/1000 rad: resting boxes lean by about as much, and their edge contacts are to stay.
static inline bool ox_supports(const ox_wedge* wedge, float3 n) {
  float outward = 0.0f;
  for (uint k = 0u; k < wedge->faces; ++k) {
    if (ox_dot(n, wedge->into[k]) > 1.0e-3f) return false;
    outward += ox_dot(n, wedge->normal[k]);
  }
  return outward > 0.0f;
}

// How far the deeper end of the chord of `in` lies below face k of `wedge`.
static inline float ox_chord_depth(const ox_wedge* in, const ox_wedge* wedge, uint k) {
  const float3 d0 = wedge->line.from - (in->line.from + in->chord[0] * in->line.along);
  const float3 d1 = wedge->line.from - (in->line.from + in->chord[1] * in->line.along);
  return ox_max(ox_dot(d0, wedge->normal[k]), ox_dot(d1, wedge->normal[k]));
}

typedef struct {
  float3 position, normal;  // normal: into A
  float depth;
} ox_point;

// Where the edges pass one another seen along n: depth is how far B's is above A's there. False:
// they are parallel, seen that way.
static inline bool ox_pass(const ox_wedge* a, const ox_wedge* b, float3 n, ox_point* point) {
  const float3 u = a->line.along;
  const float3 v = b->line.along;
  const float3 w = ox_plain_cross(u, v);
  const float area = ox_dot(w, n);
  if (!(fabs(area) > 1.0e-6f)) return false;
  const float3 d = b->line.from - a->line.from;
  const float3 dv = ox_plain_cross(d, v);
  const float3 du = ox_plain_cross(d, u);
  const float s = ox_min(ox_max(ox_dot(dv, n) / area, a->chord[0]), a->chord[1]);
  const float r = ox_min(ox_max(ox_dot(du, n) / area, b->chord[0]), b->chord[1]);
  const float3 on_a = a->line.from + s * u;
  const float3 on_b = b->line.from + r * v;
  point->position = 0.5f * (on_a + on_b);
  point->normal = n;
  point->depth = ox_dot(on_b - on_a, n);
  return true;
}

// The contact of the two edges, if there is one. A face of one mesh is an axis as good as the
// common normal of the edges; the shallowest decides.
static inline bool ox_edge_contact(const ox_wedge* a, const ox_wedge* b, ox_point* point) {
  float face_depth = INFINITY;
  float3 face_normal = (float3)(0.0f);  // into A
  bool face_of_b = false;
  for (uint k = 0u; k < b->faces; ++k) {
    const float depth = ox_chord_depth(a, b, k);
    if (depth < face_depth) {
      face_depth = depth;
      face_normal = b->normal[k];
      face_of_b = true;
    }
  }
  for (uint k = 0u; k < a->faces; ++k) {
    const float depth = ox_chord_depth(b, a, k);
    if (depth < face_depth) {
      face_depth = depth;
      face_normal = -a->normal[k];
      face_of_b = false;
    }
  }
  if (face_depth == INFINITY) return false;
  // Rounding makes the depth of faces in one plane negative; that axis stays the best nevertheless.
  face_depth = ox_max(face_depth, 0.0f);

  const float3 u = a->line.along;
  const float3 v = b->line.along;
  float3 n = ox_plain_cross(u, v);
  const float sine = sqrt(ox_dot(n, n));
  if (sine > 0.05f) {  // below 3 degrees the axis is mostly noise
    n = n / sine;
    if (!ox_supports(b, n)) n = -n;
    if (ox_supports(b, n) && ox_supports(a, -n) && ox_pass(a, b, n, point) &&
        point->depth >= 0.0f && point->depth < 1.5f * face_depth &&
        point->depth <= a->chord[1] - a->chord[0] && point->depth <= b->chord[1] - b->chord[0])
      return true;
  }
  // Else a corner of where two faces overlap: only if a face of the other edge opposes, within 20
  // degrees.
  const ox_wedge* other = face_of_b ? a : b;
  const float3 towards = face_of_b ? -face_normal : face_normal;
  bool opposed = false;
  for (uint k = 0u; k < other->faces; ++k)
    opposed = opposed || ox_dot(other->normal[k], towards) > 0.9397f;
  // 1 %: the corner lies on edges whose deepest ends gave the depth.
  return opposed && ox_pass(a, b, face_normal, point) && point->depth >= 0.0f &&
         point->depth <= 1.01f * face_depth;
}

#endif
#endif
