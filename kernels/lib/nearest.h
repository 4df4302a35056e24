// SPDX-License-Identifier: BSD-3-Clause
// What a ray meets of a mesh, gathered triangle by triangle in any order, and what that means for
// the vertex it starts from (Hermann 2008). Device only.
//
// A vertex of the source is in contact where its ray, cast along -normal, first meets a back face
// of the target after leaving the surface it may lie on.
#ifndef ODE_EXT_KERNELS_LIB_NEAREST_H
#define ODE_EXT_KERNELS_LIB_NEAREST_H

#include "lib/general_position.h"
#include "lib/ray_triangle.h"

// A ray, and how far it counts.
typedef struct {
  ox_cast cast;
  float3 direction;
  float epsilon;    // [m] |t| up to which the vertex lies on a face
  float t_max;      // [m] nothing beyond exists
  float behind;     // [m] how far back the line is looked at, for temporal data
  float entry;      // [m] how far on the vertex is that lies on a face where the ray enters
  bool two_sided;   // the target is a sheet: every face is met from behind
  uint sheet_side;  // OX_SHEET_...: but where it is known where the source is, from there alone
  bool known;       // it is inside, whatever is met first: it leaves by the first back face
} ox_query;

// One that goes on for ever, of whose origin nothing is known, into a mesh with a front; from a
// base on.
static inline ox_query ox_endless_query(float3 base, float3 origin, float3 direction,
                                        float epsilon) {
  ox_query query;
  query.cast = ox_cast_from(base, origin, direction);
  query.direction = direction;
  query.epsilon = epsilon;
  query.t_max = INFINITY;
  query.behind = query.entry = 0.0f;
  query.two_sided = false;
  query.sheet_side = OX_SHEET_UNTOLD;
  query.known = false;
  return query;
}

// A distance is finite exactly where there is a triangle: ox_consider_met sets both, of finite ones
// only. So the lesser of two that are not equal has a triangle.
typedef struct {
  float back_t, front_t;  // nearest beyond epsilon; INFINITY: none
  float behind_t;         // nearest back face before -epsilon; -INFINITY: none
  float touching_t;
  uint back, front, behind, touching;  // triangles, over all meshes; OX_NONE: none
  bool entered;                        // it starts on a front face: on the surface, going in
} ox_nearest;

static inline ox_nearest ox_nothing(void) {
  ox_nearest nearest;
  nearest.back_t = INFINITY;
  nearest.front_t = INFINITY;
  nearest.behind_t = -INFINITY;
  nearest.touching_t = 0.0f;
  nearest.back = OX_NONE;
  nearest.front = OX_NONE;
  nearest.behind = OX_NONE;
  nearest.touching = OX_NONE;
  nearest.entered = false;
  return nearest;
}

// A ray along a face (less than 6 degrees off) does not leave by it: a vertex at the foot of a wall
// touches the floor, not the wall.
static inline bool ox_leaves_by(const ox_query* query, __global const ox_triangle* triangles,
                                uint k) {
  return fabs(ox_dot(query->direction, vload3(0, triangles[k].normal))) > 0.1f;
}

// Of the faces that a vertex lies on, the one that the ray leaves most directly says where to: on
// an edge the ray may run along the other. Ties go by the index.
static inline bool ox_faces_more(const ox_query* query, __global const ox_triangle* triangles,
                                 uint a, uint b) {
  const float slope_a = fabs(ox_dot(query->direction, vload3(0, triangles[a].normal)));
  const float slope_b = fabs(ox_dot(query->direction, vload3(0, triangles[b].normal)));
  return slope_a != slope_b ? slope_a > slope_b : a < b;
}

// Whether triangle k, met at t, comes before what was met at nearest_t. Ties go by the index.
static inline bool ox_is_nearer(uint k, float t, uint nearest, float nearest_t) {
  return t != nearest_t ? t < nearest_t : k < nearest;
}

// Triangle k is met at t; back: the ray leaves through it.
static inline void ox_consider_met(const ox_query* query, __global const ox_triangle* triangles,
                                   uint k, float t, bool back, ox_nearest* nearest) {
  if (query->two_sided)
    back = query->sheet_side == OX_SHEET_UNTOLD || back == (query->sheet_side == OX_SHEET_FRONT);
  const float epsilon = query->epsilon;
  if (t < -epsilon) {
    if (back && t > nearest->behind_t) {
      nearest->behind_t = t;
      nearest->behind = k;
    }
  } else if (t <= epsilon || (!back && t <= query->entry + epsilon)) {
    // The vertex lies on this face: an entry does not count, an exit is a touch. epsilon is the
    // worst that rounding can do, a quarter of it already rare: what is farther outside than that
    // does not touch.
    if (!back)
      nearest->entered = true;
    else if (t >= -0.25f * epsilon && ox_leaves_by(query, triangles, k) &&
             (nearest->touching == OX_NONE ||
              ox_faces_more(query, triangles, k, nearest->touching))) {
      nearest->touching = k;
      nearest->touching_t = t;
    }
  } else if (t > query->t_max) {
    return;
  } else if (!back) {
    if (ox_is_nearer(k, t, nearest->front, nearest->front_t)) {
      nearest->front_t = t;
      nearest->front = k;
    }
  } else if (ox_is_nearer(k, t, nearest->back, nearest->back_t)) {
    nearest->back_t = t;
    nearest->back = k;
  }
}

static inline void ox_consider(const ox_query* query, __global const ox_triangle* triangles, uint k,
                               ox_nearest* nearest) {
  __global const ox_triangle* triangle = triangles + k;
  float t;
  bool back;
  if (ox_meets(&query->cast, vload3(0, triangle->a), vload3(0, triangle->b), vload3(0, triangle->c),
               &t, &back))
    ox_consider_met(query, triangles, k, t, back, nearest);
}

// [m] what rounding can do to how far something is: to what is farther than the pair is large, as
// what a ray meets of a large mesh, more than to coordinates.
static inline float ox_blur_of(float epsilon, float t) { return ox_max(epsilon, OX_ROUNDING * t); }

// How far it is worth looking: within rounding of the nearest hit another may decide what the
// nearest means. What lies beyond changes nothing.
static inline float ox_limit(const ox_query* query, const ox_nearest* nearest) {
  const float first = query->known ? nearest->back_t : ox_min(nearest->front_t, nearest->back_t);
  return ox_min(query->t_max, first + ox_blur_of(query->epsilon, first));
}

// A front and a back face at one distance: the ray grazes a ridge from outside, or leaves and
// enters again in a valley from inside.
static inline bool ox_grazes(const ox_nearest* nearest, float epsilon) {
  return nearest->back != OX_NONE &&
         fabs(nearest->back_t - nearest->front_t) <= ox_blur_of(epsilon, nearest->back_t);
}

// What a vertex's ray came to.
typedef struct {
  uint kind;  // OX_HIT_..., with OX_HIT_REVERSED
  uint triangle;
  float t, depth;
} ox_outcome;

static inline ox_outcome ox_miss(void) {
  ox_outcome outcome;
  outcome.kind = OX_HIT_NONE;
  outcome.triangle = OX_NONE;
  outcome.t = INFINITY;
  outcome.depth = 0.0f;
  return outcome;
}

// A hit at t of a face that the direction leaves through.
static inline ox_outcome ox_exit_through(__global const ox_triangle* triangles, uint triangle,
                                         float3 direction, float t, float exit, float epsilon) {
  ox_outcome outcome;
  const float slope = ox_dot(direction, vload3(0, triangles[triangle].normal));
  outcome.kind = t <= exit + epsilon ? OX_HIT_INSIDE : OX_HIT_FALLBACK;
  outcome.triangle = triangle;
  outcome.t = t;
  outcome.depth = t * ox_max(slope, 0.0f);
  return outcome;
}

// `inside`: what other rays say where this one grazes. exit: where it leaves its own mesh.
static inline ox_outcome ox_judge(const ox_query* query, const ox_nearest* nearest, bool inside,
                                  float exit, __global const ox_triangle* triangles) {
  if (!ox_grazes(nearest, query->epsilon)) inside = nearest->back_t < nearest->front_t;
  // A hit beyond the source's exit counts for proving the vertex inside. On the surface it is not:
  // it may be the far side of a plate thinner than epsilon.
  if (nearest->entered && !(nearest->back_t <= exit + query->epsilon)) inside = false;
  // What is known to be inside and lies on a face leaves by that, not by what is met behind it.
  if (query->known) inside = nearest->back != OX_NONE && nearest->touching == OX_NONE;
  if (inside) {
    const float slope = ox_dot(query->direction, vload3(0, triangles[nearest->back].normal));
    const bool reversed = query->two_sided && slope < 0.0f;
    ox_outcome outcome =
        ox_exit_through(triangles, nearest->back, reversed ? -query->direction : query->direction,
                        nearest->back_t, exit, query->epsilon);
    // The ray enters the target where it starts and leaves it where it leaves its own mesh: the
    // surfaces run along one another on both sides. It is inside, but no face separates it here.
    if (nearest->entered && nearest->back_t >= exit - query->epsilon)
      outcome.kind = OX_HIT_FALLBACK;
    if (reversed) outcome.kind |= OX_HIT_REVERSED;
    return outcome;
  }
  ox_outcome outcome = ox_miss();
  if (nearest->touching == OX_NONE) return outcome;
  outcome.kind = query->known ? OX_HIT_INSIDE : OX_HIT_TOUCHING;
  if (query->two_sided &&
      ox_dot(query->direction, vload3(0, triangles[nearest->touching].normal)) < 0.0f)
    outcome.kind |= OX_HIT_REVERSED;
  outcome.triangle = nearest->touching;
  // Within epsilon, and yet not 0 where it is inside: what rests on depths of 0 drifts off.
  outcome.t = ox_max(nearest->touching_t, 0.0f);
  outcome.depth =
      outcome.t * fabs(ox_dot(query->direction, vload3(0, triangles[nearest->touching].normal)));
  return outcome;
}

// The triangle by which the next pass will find its place again: where the line leaves the target
// if the vertex is inside, else the nearest surface on the line; OX_NONE: nothing near.
static inline uint ox_to_remember(const ox_nearest* nearest) {
  if (nearest->back_t < nearest->front_t) return nearest->back;
  if (nearest->front_t < -nearest->behind_t) return nearest->front;
  return nearest->behind;
}

#endif
