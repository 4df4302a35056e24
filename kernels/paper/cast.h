// SPDX-License-Identifier: BSD-3-Clause
// A ray of a vertex by one of the three algorithms, the same in both organizations. Device only.
#ifndef ODE_EXT_KERNELS_PAPER_CAST_H
#define ODE_EXT_KERNELS_PAPER_CAST_H

#include "abi/paper.h"
#include "lib/vertex_ray.h"
#include "paper/iterative_ray.h"

// Casts a ray by one of the algorithms, and leaves its temporal datum. False: an iterative ray that
// has to be cast in full, since the walk failed, or since what it found need not be the first that
// the ray meets and is not taken for that as the paper does. No more than what lies before
// ray->triangle is then looked at.
static inline bool ox_cast_ray(const ox_scene* scene, uint list, ox_ray* ray, uint walk_limit,
                               __global ox_temporal* temporal, ox_outcome* outcome, ox_work* work) {
  const uint side = ray->pair_side & 1u;
  __global const ox_pair* pair = scene->pairs + (ray->pair_side >> 1);
  __global const ox_mesh* target = scene->meshes + pair->mesh[1u - side];
  const ox_vertex_ray vertex_ray =
      ox_ray_of(pair, side, scene->meshes, scene->vertices + ray->vertex, OX_SHEET_UNTOLD);
  // What is up to half an edge behind the vertex it may pass through in the next passes.
  const float behind = ray->memory == OX_NONE ? 0.0f : 0.5f * target->mean_edge;
  uint remember = ray->triangle;
  if (list == OX_LIST_RAYS_ITERATIVE) {
    const bool found = ox_cast_iteratively(scene, &vertex_ray, target, walk_limit, behind,
                                           &remember, outcome, &work->iterative);
    if (!found || (scene->modes & OX_MODE_PAPER) == 0u) {
      ray->triangle = remember == OX_NONE ? OX_NONE : remember - target->triangle_first;
      return false;
    }
  } else {
    const bool basic = list == OX_LIST_RAYS_BASIC;
    const uint seed = ray->triangle == OX_NONE ? OX_NONE : target->triangle_first + ray->triangle;
    *outcome = ox_cast_in_full(basic, &vertex_ray, target, &scene->surfaces, seed, behind,
                               &remember, basic ? &work->basic : &work->bvh);
  }
  if (ray->memory != OX_NONE)
    temporal[ray->memory].triangle =
        remember == OX_NONE ? OX_NONE : remember - target->triangle_first;
  return true;
}

#endif
