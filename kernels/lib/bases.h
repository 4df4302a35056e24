// SPDX-License-Identifier: BSD-3-Clause
// Where the coordinates of a pair are taken from (ox_pair in abi/types.h). A body on a terrain of
// kilometres meets a few meters of it: from there floats hold both a thousand times as closely as
// from the origin of the terrain. Device only.
#ifndef ODE_EXT_KERNELS_LIB_BASES_H
#define ODE_EXT_KERNELS_LIB_BASES_H

#include "lib/general_position.h"
#include "lib/meshlet_tree.h"
#include "lib/scene.h"

// So many times as short have coordinates to be from bases as from origins for these to be taken:
// a few bits are not worth another frame.
#define OX_WORTH_A_BASE 32.0f

// A sum, and what it was rounded by.
typedef struct {
  float3 value, rest;
} ox_twofold;

// Knuth's.
static inline ox_twofold ox_sum(float3 a, float3 b) {
  ox_twofold sum;
  sum.value = a + b;
  const float3 part = sum.value - a;
  sum.rest = (a - (sum.value - part)) + (b - part);
  return sum;
}

// From b to a.
static inline ox_twofold ox_apart(__global const ox_object* a, __global const ox_object* b) {
  const ox_twofold high = ox_sum(vload3(0, a->hi), -vload3(0, b->hi));
  ox_twofold both = ox_sum(high.value, vload3(0, a->lo) - vload3(0, b->lo));
  both.rest += high.rest;
  return both;
}

// d turned back by the rotation of an object, as floats have it.
static inline float3 ox_turned_back(__global const float* rotation, float3 d) {
  return vload3(0, rotation) * d.x + vload3(1, rotation) * d.y + vload3(2, rotation) * d.z;
}

// And what is missing from that.
static inline float3 ox_rest_of_turned_back(__global const ox_object* object, ox_twofold d) {
  const float3 x = vload3(0, object->rotation);
  const float3 y = vload3(1, object->rotation);
  const float3 z = vload3(2, object->rotation);
  const float3 px = x * d.value.x;
  const float3 py = y * d.value.y;
  const float3 pz = z * d.value.z;
  const ox_twofold first = ox_sum(px, py);
  const ox_twofold all = ox_sum(first.value, pz);
  const float3 of_products = fma(x, (float3)(d.value.x), -px) + fma(y, (float3)(d.value.y), -py) +
                             fma(z, (float3)(d.value.z), -pz);
  return of_products + first.rest + all.rest + ox_turned_back(object->rotation, d.rest) +
         ox_turned_back(object->rotation_rest, d.value);
}

// How far from a base the meshlets reach that a box meets [m]; or something beyond `limit`.
static inline float ox_reach_in_box(const ox_scene* scene, __global const ox_mesh* mesh,
                                    const ox_box* box, float3 base, float limit) {
  float farthest = 0.0f;
  ox_box_walk walk = ox_begin_box_walk(mesh);
  while (walk.count != 0u && farthest <= limit) {
    __global const ox_meshlet_node* node =
        scene->surfaces.nodes + mesh->meshlet_node_first + (walk.child[--walk.count] >> 1);
    for (uint first = 0u; first < node->count; first += OX_VECTOR_WIDTH) {
      uint met = ox_children_in_box(box, node, first / OX_VECTOR_WIDTH);
      for (; met != 0u; met &= met - 1u) {
        const uint k = first + ox_lowest(met);
        if ((node->child[k] & OX_CHILD_MESHLET) == 0u) {
          walk.child[walk.count++] = node->child[k];
          continue;
        }
        const float3 lo = (float3)(node->lo[0][k], node->lo[1][k], node->lo[2][k]) - base;
        const float3 hi = (float3)(node->hi[0][k], node->hi[1][k], node->hi[2][k]) - base;
        const float3 far = OX_GREATER(fabs(lo), fabs(hi));
        farthest = ox_max(farthest, sqrt(ox_dot(far, far)));
      }
    }
  }
  return farthest;
}

static inline void ox_take_origins(__global ox_pair* pair) {
  for (uint side = 0u; side < 2u; ++side) {
    vstore3((float3)(0.0f), 0, pair->base[side]);
    vstore3(vload3(0, pair->offset[side]), 0, pair->base_offset[side]);
  }
}

// How far from a base the box of a mesh reaches [m].
static inline float ox_reach_of_box(__global const ox_mesh* mesh, float3 base) {
  const float3 far = fabs(vload3(0, mesh->box_centre) - base) + vload3(0, mesh->box_half);
  return sqrt(ox_dot(far, far));
}

// Takes bases where one mesh is small beside what there is of the pair, `size`: its own origin, and
// the place of that in the other mesh. Of that one what the box of the small one meets counts; of a
// deformable one all of it, since its meshlets are cut in a shape that it had before. Returns how
// large coordinates then are [m].
static inline float ox_choose_bases(const ox_scene* scene, __global const ox_object* a,
                                    __global const ox_object* b, float size,
                                    __global ox_pair* pair) {
  __global const ox_mesh* mesh_a = scene->meshes + a->mesh;
  __global const ox_mesh* mesh_b = scene->meshes + b->mesh;
  ox_take_origins(pair);
  const bool is_small = mesh_a->extent <= mesh_b->extent;
  const uint small = is_small ? 0u : 1u;
  const uint large = 1u - small;
  __global const ox_mesh* small_mesh = is_small ? mesh_a : mesh_b;
  __global const ox_mesh* large_mesh = is_small ? mesh_b : mesh_a;
  const float limit = size / OX_WORTH_A_BASE - small_mesh->extent;
  if (!(limit > 0.0f && limit < INFINITY)) return size;
  const float3 base = vload3(0, pair->offset[small]);
  const ox_box box = ox_target_box(pair, large, small_mesh);
  const float reach = (large_mesh->flags & OX_MESH_DEFORMABLE) != 0u
                          ? ox_reach_of_box(large_mesh, base)
                          : ox_reach_in_box(scene, large_mesh, &box, base, limit);
  if (!(reach <= limit)) return size;
  const float3 rest =
      ox_rest_of_turned_back(is_small ? b : a, is_small ? ox_apart(a, b) : ox_apart(b, a));
  vstore3(base, 0, pair->base[large]);
  vstore3(rest, 0, pair->base_offset[small]);
  vstore3(-ox_rotate(pair, large, rest), 0, pair->base_offset[large]);
  return small_mesh->extent + reach + fabs(rest.x) + fabs(rest.y) + fabs(rest.z);
}

#endif
