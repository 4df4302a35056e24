// SPDX-License-Identifier: BSD-3-Clause
// Features, and what they are of. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_FEATURE_H
#define ODE_EXT_KERNELS_CONTACTS_FEATURE_H

#include "abi/contacts.h"
#include "contacts/constants.h"
#include "lib/append.h"
#include "lib/flat.h"
#include "lib/general_position.h"

static inline uint ox_crossing_count(const ox_scene* scene) {
  return ox_length(scene, OX_LIST_CROSSINGS);
}

static inline uint ox_feature_count(const ox_scene* scene) {
  return ox_crossing_count(scene) + ox_length(scene, OX_LIST_HITS);
}

static inline uint ox_side_of(uint flags) { return flags & OX_FEATURE_SIDE; }
static inline bool ox_is_vertex(uint flags) { return (flags & OX_FEATURE_VERTEX) != 0u; }

// A point as mesh `side` has it in the frame of B, from the base there: so are all of regions.
static inline float3 ox_in_b(const ox_scene* scene, uint pair, uint side, float3 p) {
  return side == 0u ? ox_place(scene->pairs + pair, 0u, p)
                    : ox_from_base(scene->pairs + pair, 1u, p);
}

static inline float3 ox_vertex_of(const ox_scene* scene, uint pair, uint side, uint vertex) {
  return ox_in_b(scene, pair, side, vload3(0, scene->vertices[vertex].position));
}

static inline float3 ox_normal_of(const ox_scene* scene, uint pair, uint side, uint triangle) {
  const float3 n = vload3(0, scene->surfaces.triangles[triangle].normal);
  return side == 0u ? ox_rotate(scene->pairs + pair, 0u, n) : n;
}

static inline uint ox_facet_of(const ox_scene* scene, uint triangle) {
  return scene->surfaces.triangles[triangle].facet;
}

// How far, at most, a corner of `other` rises over the plane of a triangle of the same mesh [m].
static inline float ox_rise(const ox_scene* scene, uint triangle, uint other) {
  __global const ox_triangle* t = scene->surfaces.triangles + triangle;
  __global const ox_triangle* o = scene->surfaces.triangles + other;
  const float3 n = vload3(0, t->normal);
  const float3 a = vload3(0, t->a);
  return ox_max(ox_dot(n, vload3(0, o->a) - a),
                ox_max(ox_dot(n, vload3(0, o->b) - a), ox_dot(n, vload3(0, o->c) - a)));
}

// Whether its mesh is not convex at an edge: one face rises over the plane of the other, by more
// than is not known of two coordinates.
static inline bool ox_is_valley(const ox_scene* scene, uint pair, uint edge) {
  const uint first = scene->edges[edge].triangle[0];
  const uint second = scene->edges[edge].triangle[1];
  if (second == OX_NONE) return false;
  const float flat = OX_INFLATION * scene->pairs[pair].epsilon;
  return ox_rise(scene, first, second) > flat && ox_rise(scene, second, first) > flat;
}

// Whether feature a comes before b in an order that does not depend on their numbers.
static inline bool ox_is_before(__global const ox_feature* a, __global const ox_feature* b) {
  const uint kind_a = a->flags & (OX_FEATURE_SIDE | OX_FEATURE_VERTEX);
  const uint kind_b = b->flags & (OX_FEATURE_SIDE | OX_FEATURE_VERTEX);
  if (kind_a != kind_b) return kind_a < kind_b;
  if (a->source != b->source) return a->source < b->source;
  return a->triangle < b->triangle;
}

#endif
