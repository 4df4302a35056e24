// SPDX-License-Identifier: BSD-3-Clause
// Deform step, the part of meshlets: what they hold of vertices and triangles, and the boxes of the
// tree over them. Which triangles, vertices and edges a meshlet has stays.
//
// in    moves, starts (deform_step.cl), vertices, triangles
// out   meshlets, meshlet_nodes: those of the meshes that moved, in place
// item  1 meshlet / child of a node over meshlets (grid-stride)
// may overflow: none
#include "lib/moves.h"

// Any normal gives a slab that holds the meshlet; the mean of its triangles' by area gives a thin
// one.
static void ox_measure_slab(__global const ox_triangle* triangles, __global ox_meshlet* meshlet) {
  float3 sum = (float3)(0.0f);
  for (uint k = 0u; k < meshlet->triangle_count; ++k) {
    __global const ox_triangle* t = triangles + meshlet->triangle[k];
    const float3 a = vload3(0, t->a);
    sum += ox_plain_cross(vload3(0, t->b) - a, vload3(0, t->c) - a);
  }
  const float norm = ox_norm(sum);
  const float3 normal = norm > 0.0f && norm < INFINITY ? sum / norm : (float3)(0.0f);
  vstore3(normal, 0, meshlet->slab_normal);
  meshlet->slab_lo = INFINITY;
  meshlet->slab_hi = -INFINITY;
  for (uint k = 0u; k < OX_LANES; ++k) {
    const float height = ox_dot(
        normal, (float3)(meshlet->vertex[0][k], meshlet->vertex[1][k], meshlet->vertex[2][k]));
    meshlet->slab_lo = ox_min(meshlet->slab_lo, height);
    meshlet->slab_hi = ox_max(meshlet->slab_hi, height);
  }
}

__kernel void deform_meshlets(__global const ox_move* moves, uint move_count,
                              __global const uint* all_starts, uint starts_first,
                              __global const ox_vertex* vertices,
                              __global const ox_triangle* triangles,
                              __global ox_meshlet* meshlets) {
  __global const uint* starts = all_starts + starts_first;
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < starts[move_count]; i += stride) {
    const uint m = ox_move_of(starts, move_count, i);
    __global ox_meshlet* meshlet = meshlets + moves[m].shape.meshlet_first + (i - starts[m]);
    meshlet->with_area = 0u;
    for (uint k = 0u; k < meshlet->triangle_count; ++k) {
      const float3 normal = vload3(0, triangles[meshlet->triangle[k]].normal);
      if (ox_dot(normal, normal) != 0.0f) meshlet->with_area |= 1u << k;
    }
    for (uint k = 0u; k < OX_LANES; ++k) {
      __global const ox_vertex* v = vertices + meshlet->vertex_index[k];
      for (uint axis = 0u; axis < 3u; ++axis) {
        meshlet->vertex[axis][k] = v->position[axis];
        meshlet->normal[axis][k] = -v->direction[axis];
      }
    }
    for (uint axis = 0u; axis < 3u; ++axis) {
      float lo = INFINITY;
      float hi = -INFINITY;
      for (uint k = 0u; k < OX_LANES; ++k) {
        lo = ox_min(lo, meshlet->vertex[axis][k]);
        hi = ox_max(hi, meshlet->vertex[axis][k]);
      }
      meshlet->lo[axis] = lo;
      meshlet->hi[axis] = hi;
    }
    ox_measure_slab(triangles, meshlet);
  }
}

__kernel void deform_meshlet_nodes(__global const ox_move* moves, uint move_count,
                                   __global const uint* all_starts, uint starts_first,
                                   __global const ox_meshlet* meshlets,
                                   __global ox_meshlet_node* meshlet_nodes) {
  __global const uint* starts = all_starts + starts_first;
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < starts[move_count]; i += stride) {
    const uint m = ox_move_of(starts, move_count, i);
    __global const ox_mesh* shape = &moves[m].shape;
    const uint k = (i - starts[m]) % OX_LANES;
    __global ox_meshlet_node* node =
        meshlet_nodes + shape->meshlet_node_first + (i - starts[m]) / OX_LANES;
    if (k >= node->count) continue;
    // As on the host: what the rounding of a ray's slabs can do (mesh_records.cpp).
    const float margin = 0x1p-20f * shape->extent;
    for (uint axis = 0u; axis < 3u; ++axis) {
      float lo = INFINITY;
      float hi = -INFINITY;
      for (uint n = node->first[k]; n < node->first[k + 1u]; ++n) {
        lo = ox_min(lo, meshlets[shape->meshlet_first + n].lo[axis]);
        hi = ox_max(hi, meshlets[shape->meshlet_first + n].hi[axis]);
      }
      node->lo[axis][k] = lo - margin;
      node->hi[axis][k] = hi + margin;
    }
  }
}
