// SPDX-License-Identifier: BSD-3-Clause
// What a plane costs a region as a whole, and whether part of the region is past it. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_WHOLE_DEPTH_H
#define ODE_EXT_KERNELS_CONTACTS_WHOLE_DEPTH_H

#include "contacts/behind_border.h"
#include "contacts/comes_back.h"

// Of the members of a block that are points of mesh `side` how far the last and the first are along
// a direction; infinitely far back and on where none is.
static inline void ox_extent_of_block(const ox_region_view* r, uint block, uint side,
                                      float3 direction, float* least, float* most) {
  const ox_ints left = (int)(r->count - OX_VECTOR_WIDTH * block) - OX_LANE_NUMBERS;
  ox_ints is_other;
  ox_others_of_block(r, block, side, &is_other);
  ox_floats along;
  ox_dot_fields(&r->members, OX_MEMBER_POSITION, block, direction, &along);
  ox_floats low = left > 0 ? along : (ox_floats)(INFINITY);
  ox_floats high = left > 0 ? along : (ox_floats)(-INFINITY);
  low = is_other ? (ox_floats)(INFINITY) : low;
  high = is_other ? (ox_floats)(-INFINITY) : high;
  *least = ox_least_of(&low);
  *most = ox_greatest_of(&high);
}

// [m] what a pair of edges costs more than a face that is as deep, as where a box rests on a box: a
// pair holds a body at one point, a face at more, and it is not for rounding to choose.
static inline float ox_edge_tie(const ox_region_view* r, const ox_plane* plane) {
  return plane->kind == OX_PLANE_EDGES ? OX_CLEARANCE * r->scene->pairs[r->pair].epsilon : 0.0f;
}

// Blocks of members which were farthest for planes that face one way, those of A and of B, and so
// may be for others that do; the last to be found replaces the first. Of a region of few blocks
// none are kept. With one in place of eight, soups of 1,600 triangles take twice as long.
#define OX_KEPT_BLOCKS 8u
typedef struct {
  uint block[2][OX_KEPT_BLOCKS];
  uint found[2];
} ox_kept_blocks;

// How far the members of a whole region reach past a plane: A down, and B up.
typedef struct {
  const ox_plane* plane;
  float reach[2];
  float past;  // [m] how far part of it is on the other side of the plane of a face
} ox_extent;

static inline ox_extent ox_begin_extent(const ox_plane* plane) {
  ox_extent extent = {plane, {plane->level[1], plane->level[0]}, 0.0f};
  if (plane->kind != OX_PLANE_EDGES) extent.reach[ox_clears_side(plane, 0u) ? 0 : 1] = -INFINITY;
  return extent;
}

// Returns whether a block reaches farther.
static inline bool ox_extend(const ox_region_view* r, uint side, uint block, ox_extent* extent) {
  const ox_plane* plane = extent->plane;
  float least, most;
  ox_extent_of_block(r, block, side, -ox_way_of(side, plane->normal), &least, &most);
  if (plane->kind != OX_PLANE_EDGES)
    extent->past = ox_max(extent->past, -plane->level[side] - least);
  const bool is_farther = most > extent->reach[side];
  if (is_farther) extent->reach[side] = most;
  return is_farther;
}

// Limits up to which a plane is looked at: how far the region may be past it, and what it may cost.
typedef struct {
  float past, cost;  // [m]
} ox_limits;

// The depth so far; infinite where part of the region is past the plane, or that and what the kind
// of plane adds exceed the limit.
static inline float ox_depth_so_far(const ox_extent* extent, float tie, const ox_limits* limits) {
  const float depth = extent->reach[0] + extent->reach[1];
  return extent->past > limits->past || depth + tie > limits->cost ? INFINITY : depth;
}

// At least so deep is the deepest of a whole region below a plane, by the blocks that are kept.
static inline float ox_least_depth(const ox_region_view* r, const ox_limits* limits,
                                   const ox_kept_blocks* kept, ox_extent* extent) {
  for (uint side = 0u; side < 2u; ++side) {
    if (!ox_clears_side(extent->plane, side)) continue;
    const uint count = min(kept->found[side], OX_KEPT_BLOCKS);
    for (uint i = 0u; i < count; ++i) ox_extend(r, side, kept->block[side][i], extent);
  }
  return ox_depth_so_far(extent, ox_edge_tie(r, extent->plane), limits);
}

// How deep the deepest of a whole region is below a plane; infinite beyond the limits.
static inline float ox_whole_depth(const ox_region_view* r, const ox_limits* limits,
                                   ox_kept_blocks* kept, ox_extent* extent) {
  const uint blocks = (r->count + OX_VECTOR_WIDTH - 1u) / OX_VECTOR_WIDTH;
  const float tie = ox_edge_tie(r, extent->plane);
  uint farthest[2] = {OX_NONE, OX_NONE};
  float depth = -INFINITY;
  for (uint block = 0u; block < blocks && depth != INFINITY; ++block) {
    for (uint side = 0u; side < 2u; ++side)
      if (ox_clears_side(extent->plane, side) && ox_extend(r, side, block, extent))
        farthest[side] = block;
    depth = ox_depth_so_far(extent, tie, limits);
  }
  for (uint side = 0u; side < 2u && blocks > OX_KEPT_BLOCKS; ++side)
    if (farthest[side] != OX_NONE)
      kept->block[side][kept->found[side]++ % OX_KEPT_BLOCKS] = farthest[side];
  if (!(depth > -INFINITY && depth < INFINITY)) return INFINITY;  // or nothing is to be moved
  depth = ox_max(depth, 0.0f);
  if (!ox_has_border(r, extent->plane)) return depth;
  const float level = extent->plane->level[ox_clears_side(extent->plane, 0u) ? 0 : 1];
  depth = ox_max(depth, level + ox_reach_behind_border(r, extent->plane, limits->cost - level));
  return depth > limits->cost ? INFINITY : depth;
}

#define OX_DIRECTIONS 27u
static inline uint ox_direction_of(float3 n) {
  const uint x = n.x > OX_ASIDE ? 2u : n.x < -OX_ASIDE ? 0u : 1u;
  const uint y = n.y > OX_ASIDE ? 2u : n.y < -OX_ASIDE ? 0u : 1u;
  const uint z = n.z > OX_ASIDE ? 2u : n.z < -OX_ASIDE ? 0u : 1u;
  return 9u * x + 3u * y + z;
}

// The search for the plane of a whole region.
typedef struct {
  ox_kept_blocks kept[OX_DIRECTIONS];
  ox_refused refused;
  float least;  // [m] what the best costs of those that walks may begin with, so far
} ox_search;

// Tries a plane for a whole region; returns whether part of the region is past it, so that it is
// not taken.
static inline bool ox_try_whole(const ox_region_view* r, const ox_plane* plane, ox_search* search,
                                ox_plane_choice* best) {
  if (plane->kind == OX_PLANE_NONE || ox_is_refused(&search->refused, plane, OX_SAME_WAY))
    return false;
  ox_kept_blocks* kept = search->kept + ox_direction_of(plane->normal);
  // From what costs more than worth it beside the least no walk begins.
  const ox_limits limits = {OX_CLEARANCE * r->scene->pairs[r->pair].epsilon,
                            ox_min(best->judged, OX_WORTH * search->least)};
  ox_extent extent = ox_begin_extent(plane);
  if (ox_least_depth(r, &limits, kept, &extent) == INFINITY) return extent.past > limits.past;
  ox_plane_choice choice = ox_no_choice();
  choice.plane = *plane;
  choice.depth = ox_whole_depth(r, &limits, kept, &extent);
  if (choice.depth == INFINITY) return extent.past > limits.past;
  const float tie = ox_edge_tie(r, plane);
  const ox_beyond beyond = ox_go_on_beyond(r, plane, choice.depth, limits.cost - tie);
  if (beyond.price + tie > limits.cost) return false;
  choice.judged = ox_max(choice.depth, beyond.price) + tie;
  choice.of_body = beyond.price > choice.depth;
  choice.all_of_body = beyond.price > ox_doubted(choice.depth);
  // A pair of edges holds where it is; its contact says how far all of the body has to go, if it
  // does.
  if (plane->kind == OX_PLANE_EDGES)
    choice.depth = ox_max(choice.depth, beyond.depth - ox_body_tie(r));
  if (ox_is_better_choice(&choice, best)) *best = choice;
  return false;
}

#endif
