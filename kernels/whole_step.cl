// SPDX-License-Identifier: BSD-3-Clause
// Whole step: all steps of a few pairs one after the other, by one work-item. On a processor a
// launch costs as much as a pair; the kernels loop over their input whatever the grid, so this
// gives the same bytes.
//
// in, out, and what may overflow: of the kernels that it calls
// item  all; there is one
//
// Kernels that call kernels are OpenCL C, and yet not every compiler's for GPUs: it is left out
// where it never runs (OX_WHOLE_STEP, pipeline/collider_start.cpp).
#ifdef OX_WHOLE_STEP
#ifndef OX_WHOLE_PROGRAM
#include "contact_step.cl"
#include "cross.cl"
#include "cull.cl"
#include "edge_contact.cl"
#include "flood.cl"
#include "match.cl"
#include "pair_step.cl"
#include "ray_step.cl"
#include "vertex_step.cl"
#endif

__kernel void whole_step(
    __global uint* counters, __global const ox_list* lists, __global const ox_object* objects,
    __global const ox_mesh* meshes, __global const ox_chunk* chunks,
    __global const uint* pair_objects, __global const ox_link* links, uint pair_count, uint step,
    uint rays_mode, float displacement_limit, __global ox_relative_pose* poses,
    __global ox_directory_entry* directory, __global ox_pair* pairs, __global uint* pair_hits,
    __global uint* pair_crossings, __global uint* heads, __global ox_range* pair_ranges,
    __global ox_chunk_task* tasks, __global const ox_meshlet_node* meshlet_nodes,
    __global ox_meshlet_task* meshlet_tasks, __global const ox_meshlet* meshlets,
    __global ox_meshlet_pair* meshlet_pairs, __global ox_edge_crossing* crossings,
    __global uint* crossing_links, __global const ox_vertex* vertices,
    __global const ox_edge* edges, __global const uint* ring_starts,
    __global const ox_neighbour* rings, __global const uint* components,
    __global const ox_triangle* triangles, __global ox_ray* rays, __global uint* words,
    __global const ox_temporal* temporal_before, __global ox_temporal* temporal, uint walk_limit,
    __global ox_hit* hits, __global uint* pair_segments, __global uint* crossing_segments,
    __global ox_candidate* candidates, __global const uint* facets,
    __global ox_edge_crossing* gathered, __global uint* order, uint max_contacts,
    uint max_deformable, __global ox_contact* contacts) {
  pair_step(counters, lists, objects, meshes, chunks, pair_objects, links, pair_count, step,
            rays_mode, displacement_limit, poses, directory, pairs, pair_hits, pair_crossings,
            heads, pair_ranges, 0u, 0, tasks);
  cull(counters, lists, pairs, meshes, meshlet_nodes, pair_count, meshlet_tasks);
  match(counters, lists, meshlet_tasks, pairs, meshes, meshlets, meshlet_nodes, rays_mode,
        meshlet_pairs, pair_crossings, crossings, heads, crossing_links);
  cross_meshlets(counters, lists, meshlet_pairs, pairs, meshes, meshlets, rays_mode, pair_crossings,
                 crossings, heads, crossing_links);
  flood(counters, lists, pairs, meshes, chunks, heads, crossings, crossing_links, vertices, edges,
        ring_starts, rings, components, triangles, meshlets, meshlet_nodes, pair_count, rays_mode,
        tasks, rays, words);
  vertex_high(counters, lists, tasks, pairs, meshes, chunks, vertices, rays_mode,
              displacement_limit, temporal_before, temporal, rays, 0);
  vertex_deformable(counters, lists, tasks, pairs, meshes, chunks, vertices, rays_mode,
                    displacement_limit, temporal_before, temporal, rays, 0);
  ray_bvh(counters, lists, rays, pairs, meshes, vertices, triangles, meshlets, meshlet_nodes,
          rays_mode, walk_limit, temporal, pair_hits, hits, 0);
  contact_place(counters, pair_hits, pair_crossings, pair_count, pair_segments, crossing_segments);
  contact_gather(counters, lists, hits, pairs, vertices, triangles, pair_segments, candidates);
  crossing_gather(counters, lists, crossings, pairs, vertices, edges, facets, crossing_segments,
                  gathered, order);
  edge_contacts(counters, pairs, meshes, chunks, vertices, edges, triangles, meshlets,
                meshlet_nodes, facets, pair_crossings, crossing_segments, pair_count, gathered,
                order, pair_hits, pair_segments, candidates);
  contact_reduce(counters, lists, pairs, meshes, pair_hits, pair_segments, pair_count, candidates,
                 max_contacts, max_deformable, rays_mode, pair_ranges, contacts);
}

#endif
