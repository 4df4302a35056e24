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
#include "contacts/choose.cl"
#include "contacts/features.cl"
#include "contacts/flood.cl"
#include "contacts/reduce.cl"
#include "cross.cl"
#include "cull.cl"
#include "match.cl"
#include "pair_step.cl"
#include "ray_step.cl"
#include "vertex_step.cl"
#endif

__kernel void whole_step(OX_SCENE_PARAMETERS, __global const ox_object* objects,
                         __global const uint* pair_objects, __global ox_range* pair_ranges,
                         __global ox_meshlet_task* meshlet_tasks,
                         __global ox_meshlet_pair* meshlet_pairs,
                         __global ox_edge_crossing* crossings, __global ox_chunk_task* tasks,
                         __global ox_ray* rays, __global uint* words, __global ox_hit* hits,
                         __global float* candidates, uint max_contacts, uint max_deformable,
                         __global ox_contact* contacts, __global ox_feature* features,
                         __global uint* parents, __global uint* slots, __global ox_region* regions,
                         __global float* members, __global ox_face* faces, __global float* planes,
                         __global uint* edge_planes) {
  pair_step(OX_SCENE_ARGUMENTS, objects, pair_objects, pair_ranges);
  cull(OX_SCENE_ARGUMENTS, meshlet_tasks);
  match(OX_SCENE_ARGUMENTS, meshlet_tasks, meshlet_pairs, crossings);
  cross_meshlets(OX_SCENE_ARGUMENTS, meshlet_pairs, crossings);
  flood(OX_SCENE_ARGUMENTS, crossings, tasks, rays, words);
  vertex_step(OX_SCENE_ARGUMENTS, tasks, rays);
  ray_step(OX_SCENE_ARGUMENTS, rays, hits);
  feature_gather(OX_SCENE_ARGUMENTS, crossings, hits, features, parents, slots, faces);
  feature_place(OX_SCENE_ARGUMENTS);
  feature_link(OX_SCENE_ARGUMENTS, features, parents, slots);
  feature_join(OX_SCENE_ARGUMENTS, crossings, features, parents, slots);
  region_begin(OX_SCENE_ARGUMENTS, features, parents, regions);
  region_count(OX_SCENE_ARGUMENTS, features, parents, regions);
  region_place(OX_SCENE_ARGUMENTS, regions);
  region_fill(OX_SCENE_ARGUMENTS, features, regions, members, faces);
  region_propose(OX_SCENE_ARGUMENTS, features, regions, faces, planes, edge_planes);
  choose_planes(OX_SCENE_ARGUMENTS, features, regions, members, faces, planes, edge_planes,
                candidates);
  reduce_candidates(OX_SCENE_ARGUMENTS, candidates, max_contacts, max_deformable, pair_ranges,
                    contacts);
}

#endif
