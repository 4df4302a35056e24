// SPDX-License-Identifier: BSD-3-Clause
// Ray step (GRAPP section 3.3): where does the ray from this vertex leave the target? One
// kernel per algorithm.
//
// in    rays of one algorithm (its list), pairs, meshes, vertices, triangles, meshlets,
//       meshlet_nodes
// out   hits, and per pair their number
//       temporal: the triangle from which the next step may start
//       rays: those that the iterative algorithm hands on to a full one
// item  1 ray (grid-stride); no barrier
// may overflow: OX_LIST_HITS; the iterative kernel also OX_LIST_RAYS_BVH, OX_LIST_RAYS_BASIC
#include "shared/cast.h"

__kernel void ray_iterative(__global volatile uint* counters, __global const ox_list* lists,
                            __global ox_ray* rays, __global const ox_pair* pairs,
                            __global const ox_mesh* meshes, __global const ox_vertex* vertices,
                            __global const ox_triangle* triangles,
                            __global const ox_meshlet* meshlets,
                            __global const ox_meshlet_node* meshlet_nodes, uint rays_mode,
                            uint walk_limit, __global ox_temporal* temporal,
                            __global volatile uint* pair_hits, __global ox_hit* hits,
                            __global ox_work* works) {
  const ox_surfaces surfaces = {triangles, meshlets, meshlet_nodes};
  const uint first = lists[OX_LIST_RAYS_ITERATIVE].first;
  const uint count = ox_length(counters, lists, OX_LIST_RAYS_ITERATIVE);
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < count; i += stride) {
    ox_ray ray = rays[first + i];
    ox_outcome outcome;
    ox_work work = {0u, 0u, 0u, 0u};
    const bool done = ox_cast_ray(OX_LIST_RAYS_ITERATIVE, &ray, pairs, meshes, vertices, &surfaces,
                                  rays_mode, walk_limit, temporal, &outcome, &work);
    ox_note_work(works, i, &work);
    if (done) {
      ox_append_hit(counters, lists, &ray, &outcome, pair_hits, hits);
      continue;
    }
    ox_count(counters, OX_COUNTER_UNPROVEN);
    const uint slot =
        ox_append(counters, lists, ox_full_list(pairs, meshes, ray.pair_side, rays_mode));
    if (slot != OX_NONE) rays[slot] = ray;
  }
}

static void ox_cast_list(uint list, __global volatile uint* counters, __global const ox_list* lists,
                         __global ox_ray* rays, __global const ox_pair* pairs,
                         __global const ox_mesh* meshes, __global const ox_vertex* vertices,
                         const ox_surfaces* surfaces, uint rays_mode, uint walk_limit,
                         __global ox_temporal* temporal, __global volatile uint* pair_hits,
                         __global ox_hit* hits, __global ox_work* works) {
  const uint first = lists[list].first;
  const uint count = ox_length(counters, lists, list);
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < count; i += stride) {
    ox_ray ray = rays[first + i];
    ox_outcome outcome;
    ox_work work = {0u, 0u, 0u, 0u};
    ox_cast_ray(list, &ray, pairs, meshes, vertices, surfaces, rays_mode, walk_limit, temporal,
                &outcome, &work);
    ox_append_hit(counters, lists, &ray, &outcome, pair_hits, hits);
    ox_note_work(works, i, &work);
  }
}

__kernel void ray_bvh(__global volatile uint* counters, __global const ox_list* lists,
                      __global ox_ray* rays, __global const ox_pair* pairs,
                      __global const ox_mesh* meshes, __global const ox_vertex* vertices,
                      __global const ox_triangle* triangles, __global const ox_meshlet* meshlets,
                      __global const ox_meshlet_node* meshlet_nodes, uint rays_mode,
                      uint walk_limit, __global ox_temporal* temporal,
                      __global volatile uint* pair_hits, __global ox_hit* hits,
                      __global ox_work* works) {
  const ox_surfaces surfaces = {triangles, meshlets, meshlet_nodes};
  ox_cast_list(OX_LIST_RAYS_BVH, counters, lists, rays, pairs, meshes, vertices, &surfaces,
               rays_mode, walk_limit, temporal, pair_hits, hits, works);
}

__kernel void ray_basic(__global volatile uint* counters, __global const ox_list* lists,
                        __global ox_ray* rays, __global const ox_pair* pairs,
                        __global const ox_mesh* meshes, __global const ox_vertex* vertices,
                        __global const ox_triangle* triangles, __global const ox_meshlet* meshlets,
                        __global const ox_meshlet_node* meshlet_nodes, uint rays_mode,
                        uint walk_limit, __global ox_temporal* temporal,
                        __global volatile uint* pair_hits, __global ox_hit* hits,
                        __global ox_work* works) {
  const ox_surfaces surfaces = {triangles, meshlets, meshlet_nodes};
  ox_cast_list(OX_LIST_RAYS_BASIC, counters, lists, rays, pairs, meshes, vertices, &surfaces,
               rays_mode, walk_limit, temporal, pair_hits, hits, works);
}
