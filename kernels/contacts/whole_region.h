// SPDX-License-Identifier: BSD-3-Clause
// The plane by which a region parts as a whole: the least of the faces at its features and of
// pairs of edges, found by going on from the best in each direction. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_WHOLE_REGION_H
#define ODE_EXT_KERNELS_CONTACTS_WHOLE_REGION_H

#include "contacts/ways.h"

// Of the members of a block that are points of mesh `side` how far the last and the first are along
// a direction; infinitely far back and on where none is.
static inline void ox_extent_of_block(const ox_region_view* r, uint block, uint side,
                                      float3 direction, float* least, float* most) {
  const int others = (int)(OX_FEATURE_VERTEX | (side == 0u ? OX_FEATURE_SIDE : 0u));
  const int mask = (int)(OX_FEATURE_VERTEX | OX_FEATURE_SIDE);
  const ox_ints left = (int)(r->count - OX_VECTOR_WIDTH * block) - OX_LANE_NUMBERS;
  const ox_ints is_other = (OX_LOAD_WORDS(&r->members, OX_MEMBER_FLAGS, block) & mask) == others;
  ox_floats along;
  ox_dot_fields(&r->members, OX_MEMBER_POSITION, block, direction, &along);
  ox_floats low = left > 0 ? along : (ox_floats)(INFINITY);
  ox_floats high = left > 0 ? along : (ox_floats)(-INFINITY);
  low = is_other ? (ox_floats)(INFINITY) : low;
  high = is_other ? (ox_floats)(-INFINITY) : high;
  *least = ox_least_of(&low);
  *most = ox_greatest_of(&high);
}

static inline float ox_edge_tie(const ox_region_view* r, const ox_plane* plane) {
  return plane->kind == OX_PLANE_EDGES ? OX_DEPTH_TIE * r->scene->pairs[r->pair].epsilon : 0.0f;
}

// Blocks of members which were farthest for planes that face one way, those of A and of B, and so
// may be for others that do; the last to be found replaces the first. Of a region of few blocks
// none are kept.
#define OX_KEPT_BLOCKS 8u
typedef struct {
  uint block[2][OX_KEPT_BLOCKS];
  uint found[2];
} ox_kept_blocks;

// How far the members of a whole region reach past a plane: A down, and B up.
typedef struct {
  const ox_plane* plane;
  float reach[2];
  bool is_past;  // part of it is on the other side of the plane of a face
} ox_extent;

static inline ox_extent ox_begin_extent(const ox_plane* plane) {
  ox_extent extent = {plane, {-plane->bottom, plane->top}, false};
  if (plane->kind != OX_PLANE_EDGES) extent.reach[ox_clears_side(plane, 0u) ? 0 : 1] = -INFINITY;
  return extent;
}

// Returns whether a block reaches farther.
static inline bool ox_extend(const ox_region_view* r, uint side, uint block, ox_extent* extent) {
  const ox_plane* plane = extent->plane;
  float least, most;
  ox_extent_of_block(r, block, side, side == 0u ? -plane->normal : plane->normal, &least, &most);
  const float past = -OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  if (plane->kind != OX_PLANE_EDGES && least + (side == 0u ? plane->top : -plane->bottom) < past)
    extent->is_past = true;
  const bool is_farther = most > extent->reach[side];
  if (is_farther) extent->reach[side] = most;
  return is_farther;
}

// The depth so far; infinite where that and what the kind of plane adds exceed a limit.
static inline float ox_depth_so_far(const ox_extent* extent, float tie, float limit) {
  const float depth = extent->reach[0] + extent->reach[1];
  return extent->is_past || depth + tie > limit ? INFINITY : depth;
}

// At least so deep is the deepest of a whole region below a plane, by the blocks that are kept.
static inline float ox_least_depth(const ox_region_view* r, const ox_plane* plane, float limit,
                                   const ox_kept_blocks* kept) {
  ox_extent extent = ox_begin_extent(plane);
  for (uint side = 0u; side < 2u; ++side) {
    if (!ox_clears_side(plane, side)) continue;
    const uint count = min(kept->found[side], OX_KEPT_BLOCKS);
    for (uint i = 0u; i < count; ++i) ox_extend(r, side, kept->block[side][i], &extent);
  }
  return ox_depth_so_far(&extent, ox_edge_tie(r, plane), limit);
}

// How deep the deepest of a whole region is below a plane; infinite where part of it is past the
// plane, or that and what its kind adds exceed `limit`.
static inline float ox_whole_depth(const ox_region_view* r, const ox_plane* plane, float limit,
                                   ox_kept_blocks* kept) {
  const uint blocks = (r->count + OX_VECTOR_WIDTH - 1u) / OX_VECTOR_WIDTH;
  const float tie = ox_edge_tie(r, plane);
  ox_extent extent = ox_begin_extent(plane);
  uint farthest[2] = {OX_NONE, OX_NONE};
  float depth = -INFINITY;
  for (uint block = 0u; block < blocks && depth != INFINITY; ++block) {
    for (uint side = 0u; side < 2u; ++side)
      if (ox_clears_side(plane, side) && ox_extend(r, side, block, &extent)) farthest[side] = block;
    depth = ox_depth_so_far(&extent, tie, limit);
  }
  for (uint side = 0u; side < 2u && blocks > OX_KEPT_BLOCKS; ++side)
    if (farthest[side] != OX_NONE)
      kept->block[side][kept->found[side]++ % OX_KEPT_BLOCKS] = farthest[side];
  return depth == -INFINITY ? INFINITY : ox_max(depth, 0.0f);  // nothing there is to be moved
}

// Directions are told apart by which of their coordinates are beyond a third, either way.
#define OX_DIRECTIONS 27u
static inline uint ox_direction_of(float3 n) {
  const float third = 1.0f / 3.0f;
  const uint x = n.x > third ? 2u : n.x < -third ? 0u : 1u;
  const uint y = n.y > third ? 2u : n.y < -third ? 0u : 1u;
  const uint z = n.z > third ? 2u : n.z < -third ? 0u : 1u;
  return 9u * x + 3u * y + z;
}

// The search for the plane of a whole region.
typedef struct {
  ox_kept_blocks kept[OX_DIRECTIONS];
  // Normals of planes that do not separate: what faces their way, within acos 0.9 = 26 degrees,
  // does not either.
  float3 refused[OX_MOST_TRIES];
  uint refused_count;
} ox_search;

static inline bool ox_is_refused(const ox_search* search, const ox_plane* plane) {
  for (uint i = 0u; i < search->refused_count; ++i)
    if (ox_dot(search->refused[i], plane->normal) > 0.9f) return true;
  return false;
}

// Tries a plane for a whole region.
static inline void ox_try_whole(const ox_region_view* r, const ox_plane* plane, ox_search* search,
                                ox_plane_choice* best) {
  if (plane->kind == OX_PLANE_NONE || ox_is_refused(search, plane)) return;
  ox_kept_blocks* kept = search->kept + ox_direction_of(plane->normal);
  if (ox_least_depth(r, plane, best->judged, kept) == INFINITY) return;
  const float tie = ox_edge_tie(r, plane);
  const float beyond = ox_depth_beyond(r, plane, best->judged - tie);
  if (beyond + tie > best->judged) return;
  ox_plane_choice choice;
  choice.plane = *plane;
  choice.depth = ox_whole_depth(r, plane, best->judged, kept);
  if (choice.depth == INFINITY) return;
  choice.judged = ox_max(choice.depth, beyond) + tie;
  // A pair of edges holds where it is; its contact says how far all of the body has to go.
  if (plane->kind == OX_PLANE_EDGES) choice.depth = ox_max(choice.depth, beyond);
  if (ox_is_better_choice(&choice, best)) *best = choice;
}

// Directions that cost so much more than the best are not looked around.
#define OX_WORTH 4.0f

// Edges of one mesh, so many at most.
#define OX_MOST_EDGES 64u
typedef struct {
  uint count;
  uint code[OX_MOST_EDGES];
} ox_edge_set;

// In ascending order, so that of too many the first are kept, in whatever order they come.
static inline void ox_add_code(ox_edge_set* set, uint code) {
  uint place = set->count;
  while (place != 0u && set->code[place - 1u] > code) --place;
  if (place == OX_MOST_EDGES || (place != 0u && set->code[place - 1u] == code)) return;
  if (set->count < OX_MOST_EDGES) ++set->count;
  for (uint i = set->count - 1u; i > place; --i) set->code[i] = set->code[i - 1u];
  set->code[place] = code;
}

static inline void ox_add_sides(const ox_region_view* r, uint side, uint triangle,
                                ox_edge_set* set) {
  for (uint k = 0u; k < 3u; ++k)
    ox_add_code(set, ox_code_of_side(r->scene, r->pair, side, triangle, k));
}

// The edges of mesh `side` at a feature.
static inline void ox_add_edges_at(const ox_region_view* r, uint side, __global const ox_feature* f,
                                   ox_edge_set* set) {
  const ox_scene* scene = r->scene;
  if (ox_is_vertex(f->flags)) {
    for (uint k = scene->ring_starts[f->source]; k < scene->ring_starts[f->source + 1u]; ++k)
      ox_add_code(set, ox_code_of_edge(scene, r->pair, side, scene->rings[k].edge));
  } else if (ox_side_of(f->flags) == side) {
    ox_add_code(set, ox_code_of_edge(scene, r->pair, side, f->source));
  } else {
    ox_add_sides(r, side, f->triangle, set);
  }
}

// Those of mesh `side` at what of it in the region is farthest past a plane, to within what is not
// known of two coordinates.
static inline void ox_add_farthest(const ox_region_view* r, uint side, float3 normal,
                                   ox_edge_set* set) {
  const float3 past = side == 0u ? -normal : normal;
  float farthest = -INFINITY;
  for (uint k = 0u; k < r->count; ++k)
    if (ox_is_on(ox_flags_of(r, k), side))
      farthest = ox_max(farthest, ox_dot(past, ox_position_of(r, k)));
  farthest -= OX_INFLATION * r->scene->pairs[r->pair].epsilon;
  for (uint k = 0u; k < r->count; ++k) {
    if (ox_is_on(ox_flags_of(r, k), side) && ox_dot(past, ox_position_of(r, k)) >= farthest)
      ox_add_edges_at(r, side, ox_feature_of(r, k), set);
  }
}

static inline bool ox_are_at_facet(const ox_scene* scene, uint first, uint second, uint facet) {
  return scene->facets[first] == facet || (second != OX_NONE && scene->facets[second] == facet);
}

// Triangles of a facet that are walked over, so many at most. A quad has two. With 64 of them the
// bowl of a thousand objects took a quarter longer, and no contact that is measured was truer.
#define OX_MOST_OF_FACET 4u

// The edges of the facet of a triangle, as far as a walk over it from there finds them.
static inline void ox_add_rim_near(const ox_region_view* r, uint side, uint triangle,
                                   ox_edge_set* set) {
  const ox_scene* scene = r->scene;
  const uint first = scene->meshes[scene->pairs[r->pair].mesh[side]].triangle_first;
  uint walked[OX_MOST_OF_FACET];
  walked[0] = triangle;
  uint count = 1u;
  for (uint i = 0u; i < count; ++i)
    for (uint k = 0u; k < 3u; ++k) {
      const uint across = ox_across(scene->surfaces.triangles + walked[i], k);
      const uint next = across == OX_NONE ? OX_NONE : first + across;
      if (next == OX_NONE || scene->facets[next] != scene->facets[triangle]) {
        ox_add_code(set, ox_code_of_side(scene, r->pair, side, walked[i], k));
        continue;
      }
      uint at = 0u;
      while (at < count && walked[at] != next) ++at;
      if (at == count && count < OX_MOST_OF_FACET) walked[count++] = next;
    }
}

// The edges of the facet of a triangle: those near it, and those at features.
static inline void ox_add_rim(const ox_region_view* r, uint side, uint triangle, ox_edge_set* set) {
  const ox_scene* scene = r->scene;
  const uint facet = scene->facets[triangle];
  ox_add_rim_near(r, side, triangle, set);
  for (uint k = 0u; k < r->count; ++k) {
    if (ox_side_of(ox_flags_of(r, k)) != side) continue;
    __global const ox_feature* f = ox_feature_of(r, k);
    if (!ox_is_vertex(f->flags)) {
      if (ox_are_at_facet(scene, f->at[0], f->at[1], facet))
        ox_add_code(set, ox_code_of_edge(scene, r->pair, side, f->source));
      continue;
    }
    for (uint i = scene->ring_starts[f->source]; i < scene->ring_starts[f->source + 1u]; ++i) {
      __global const ox_edge* edge = scene->edges + scene->rings[i].edge;
      if (ox_are_at_facet(scene, edge->triangle[0], edge->triangle[1], facet))
        ox_add_code(set, ox_code_of_edge(scene, r->pair, side, scene->rings[i].edge));
    }
  }
}

// From a plane to the best of those next to it on the map of directions (Gauss): the edges of its
// face, or its own, with the edges at what is farthest past it. False: none is better.
static inline bool ox_walk_on(const ox_region_view* r, ox_search* search, ox_plane_choice* best) {
  const ox_plane from = best->plane;
  for (uint side = 0u; side < 2u; ++side) {
    if (!ox_clears_side(&from, side)) continue;
    ox_edge_set own, past;
    own.count = past.count = 0u;
    if (from.kind == OX_PLANE_EDGES)
      own.code[own.count++] = from.id[1u - side];
    else
      ox_add_rim(r, 1u - side, from.id[0], &own);
    ox_add_farthest(r, side, from.normal, &past);
    for (uint i = 0u; i < own.count; ++i)
      for (uint k = 0u; k < past.count; ++k) {
        const ox_plane plane =
            side == 0u ? ox_plane_of_edges(r->scene, r->pair, past.code[k], own.code[i])
                       : ox_plane_of_edges(r->scene, r->pair, own.code[i], past.code[k]);
        ox_try_whole(r, &plane, search, best);
      }
  }
  if (from.kind == OX_PLANE_EDGES)
    for (uint side = 0u; side < 2u; ++side) {
      if (!ox_parts_by_faces_of(r->scene, r->pair, r->flags, side)) continue;
      const ox_ridge ridge = ox_ridge_of(r->scene, r->pair, side, from.id[side]);
      for (uint k = 0u; k < 2u; ++k) {
        if (ridge.face[k] == OX_NONE) continue;
        const ox_plane plane = ox_plane_of_face(r->scene, r->pair, side, ridge.face[k]);
        ox_try_whole(r, &plane, search, best);
      }
    }
  return best->plane.kind != from.kind || best->plane.id[0] != from.id[0] ||
         best->plane.id[1] != from.id[1];
}

// What a plane costs is least in several directions at once, as a box is thin in three: from the
// best in each the best next to it is looked for.
static inline ox_plane_choice ox_search_whole(const ox_region_view* r, ox_search* search) {
  ox_plane_choice best[OX_DIRECTIONS];
  for (uint i = 0u; i < OX_DIRECTIONS; ++i) best[i] = ox_no_choice();
  for (uint i = 0u; i < r->plane_count; ++i) {
    const ox_plane plane = ox_load_plane(&r->planes, i);
    ox_try_whole(r, &plane, search, best + ox_direction_of(plane.normal));
  }
  ox_plane_choice least = ox_no_choice();
  for (uint i = 0u; i < OX_DIRECTIONS; ++i)
    if (ox_is_better_choice(best + i, &least)) least = best[i];
  const float worth = OX_WORTH * least.judged;
  for (uint i = 0u; i < OX_DIRECTIONS; ++i) {
    if (best[i].plane.kind == OX_PLANE_NONE || !(best[i].judged <= worth)) continue;
    while (ox_walk_on(r, search, best + i)) {
    }
    if (ox_is_better_choice(best + i, &least)) least = best[i];
  }
  return least;
}

// Of the members that are points of mesh `side` the farthest past a plane; OX_NONE: there is none,
// as of what contains the other mesh.
static inline uint ox_find_farthest(const ox_region_view* r, uint side, float3 normal) {
  const float3 past = side == 0u ? -normal : normal;
  uint best = OX_NONE;
  float farthest = -INFINITY;
  for (uint k = 0u; k < r->count; ++k) {
    const float here = ox_dot(past, ox_position_of(r, k));
    if (!ox_is_on(ox_flags_of(r, k), side) || here < farthest ||
        (here == farthest && !ox_is_before(ox_feature_of(r, k), ox_feature_of(r, best))))
      continue;
    farthest = here;
    best = k;
  }
  return best;
}

// Where a body goes on beyond its region the faces at features may be far from the nearest: those
// nearest to vertices inside and to the middles of chords are tried too.
static inline void ox_try_nearest(const ox_region_view* r, ox_search* search,
                                  ox_plane_choice* best) {
  if (!(best->judged > best->depth + ox_edge_tie(r, &best->plane))) return;
  const float bound = best->judged;  // the same for all, in whatever order they come
  for (uint k = 0u; k < r->count; ++k) {
    const uint flags = ox_flags_of(r, k);
    if ((flags & OX_MEMBER_BEGINS) == 0u) continue;
    const ox_plane plane = ox_nearest_face(r, ox_side_of(flags), ox_middle_of(r, k), bound);
    ox_try_whole(r, &plane, search, best);
  }
}

// Whether what of a body goes first or last stays inside the other where a plane takes it. A
// crossing says nothing: it is on the surface, and where it goes along a wall it stays on it.
static inline bool ox_whole_stays(const ox_region_view* r, const ox_plane_choice* choice) {
  for (uint side = 0u; side < 2u; ++side)
    for (uint end = 0u; end < 2u && ox_clears_side(&choice->plane, side); ++end) {
      const float3 normal = end == 0u ? choice->plane.normal : -choice->plane.normal;
      const uint k = ox_find_farthest(r, side, normal);
      if (k != OX_NONE &&
          ox_stays_inside(r, side, ox_middle_of(r, k), &choice->plane, choice->depth))
        return true;
    }
  return false;
}

// The least plane. Where one does not separate the bodies, the way along its normal is past all of
// both.
static inline ox_plane_choice ox_choose_whole(const ox_region_view* r) {
  ox_search search;
  for (uint i = 0u; i < OX_DIRECTIONS; ++i) search.kept[i].found[0] = search.kept[i].found[1] = 0u;
  ox_plane_choice of_body = ox_no_choice();
  for (search.refused_count = 0u; search.refused_count < OX_MOST_TRIES; ++search.refused_count) {
    ox_plane_choice best = ox_search_whole(r, &search);
    ox_try_nearest(r, &search, &best);
    if (best.plane.kind == OX_PLANE_NONE || !ox_is_better_choice(&best, &of_body)) break;
    // Of what is wholly inside the planes of the other are not known all round.
    if ((r->flags & OX_REGION_CROSSED) == 0u || !ox_whole_stays(r, &best)) return best;
    search.refused[search.refused_count] = best.plane.normal;
    best.judged = ox_max(best.judged, ox_depth_of_both(r, best.plane.normal));
    if (ox_is_better_choice(&best, &of_body)) of_body = best;
  }
  return of_body;
}

#endif
