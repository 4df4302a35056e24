// SPDX-License-Identifier: BSD-3-Clause
// The rays of the vertices that a flood has reached. Device only.
#ifndef ODE_EXT_KERNELS_LIB_FLOOD_RAYS_H
#define ODE_EXT_KERNELS_LIB_FLOOD_RAYS_H

#include "lib/flat.h"
#include "lib/flood_state.h"
#include "lib/vertex_ray.h"
#include "lib/way_up.h"

// How deep what of a solid is behind an open target is by the rays of its vertices, which go as far
// as it is thick [m]. What is deeper, as of a plank or a post that went in by its end, is behind it
// all the same. What bounds nothing, as a vertex in the midst of a flat end, tells nothing of the
// rest. Not so of what no crossing tells, nor of a finely cut solid that came from behind, all of
// which would be as deep as it is large: each vertex takes a walk.
#define OX_MANY_BEHIND 64u
static inline float ox_depth_of_rays(const ox_flood_state* s, const ox_way_up* way) {
  const bool is_from_behind = 2u * s->crossed > OX_CHUNK_VERTICES * s->source->chunk_count;
  if (way->height == -INFINITY || (s->crossed > OX_MANY_BEHIND && is_from_behind)) return INFINITY;
  float deepest = 0.0f;
  for (uint i = OX_ITEM; i < s->crossed; i += OX_ITEMS) {
    const uint vertex = ox_queued(s, i);
    if (ox_ray_gets_above(s->scene, vertex, way) &&
        !ox_is_flat_vertex(s->scene, s->pair, s->pair_side & 1u, vertex))
      deepest = ox_max(deepest, ox_depth_below(s->scene, vertex, way));
  }
  return -ox_least_of_items(-deepest);
}

// What hangs together lies in the queue one after the other; all of it names the first of it that
// bounds anything.
static inline void ox_cast_queue(const ox_flood_state* s) {
  const ox_way_up way = ox_find_way_up(s->scene, s->pair_side);
  const float known = ox_depth_of_rays(s, &way);
  // Of a fine mesh other vertices are as near the border as matters.
  const bool has_no_border =
      known < INFINITY && s->crossed <= OX_MANY_BEHIND &&
      s->scene->found[s->pair_side >> 1].at_border[1u - (s->pair_side & 1u)] == 0u;
  uint last = OX_NONE;  // the first of what the block before ended in
  for (uint begin = 0u; begin < s->table.queued; begin += OX_ITEMS) {
    const uint i = begin + OX_ITEM;
    const bool is_queued = i < s->table.queued;
    const uint vertex = is_queued ? ox_queued(s, i) : OX_NONE;
    if (ox_is_open(s)) {
      const bool lies = i >= s->crossed;
      const bool is_deep = is_queued && !lies && ox_depth_below(s->scene, vertex, &way) > known;
      const bool is_reached = is_queued && !lies && !is_deep && has_no_border;
      const bool casts =
          is_queued &&
          (lies || is_deep || is_reached ? ox_casts_ray(s->scene->vertices + vertex)
                                         : ox_may_cast(s->scene, s->pair_side, vertex)) &&
          !(s->is_below && ox_is_flat_vertex(s->scene, s->pair, s->pair_side & 1u, vertex));
      const uint index = ox_append_each(s->scene, OX_LIST_RAYS, casts);
      if (casts)
        ox_store_ray(s->scene, index, s->pair_side, vertex,
                     s->is_below  ? OX_RAY_BEHIND
                     : lies       ? OX_RAY_CONTAINED
                     : is_deep    ? OX_RAY_BEHIND
                     : is_reached ? OX_RAY_REACHED
                                  : OX_RAY_ASKING,
                     OX_NONE);
      continue;
    }
    const bool begins = is_queued && (ox_queue(s->scene, &s->table)[i] & OX_QUEUE_BEGINS) != 0u;
    const bool bounds =
        is_queued && !ox_is_flat_vertex(s->scene, s->pair, s->pair_side & 1u, vertex);
    const uint index = ox_append_each(s->scene, OX_LIST_RAYS, bounds);
    const uint all_bounding = ox_group_bits(bounds);
    // Of a work-item and those before it: from the last that begins on.
    const uint up_to_own = (2u << OX_ITEM) - 1u;
    const uint beginning = ox_group_bits(begins) & up_to_own;
    const uint together = beginning == 0u ? ~0u : ~((1u << (31u - clz(beginning))) - 1u);
    const uint bounding = all_bounding & up_to_own & together;
    const uint there = ox_of_item(vertex, bounding == 0u ? 0u : ox_lowest(bounding));
    uint first = bounding == 0u ? OX_NONE : there;
    if (beginning == 0u && last != OX_NONE) first = last;
    if (bounds)
      ox_store_ray(s->scene, index, s->pair_side, vertex,
                   i < s->crossed ? OX_RAY_INSIDE : OX_RAY_CONTAINED, first);
    last = ox_of_item(first, OX_ITEMS - 1u);
  }
}

#endif
