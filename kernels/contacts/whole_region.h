// SPDX-License-Identifier: BSD-3-Clause
// The plane by which a region parts as a whole: the least of the faces at its features and of
// pairs of edges, found by going on from the best in each direction. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_WHOLE_REGION_H
#define ODE_EXT_KERNELS_CONTACTS_WHOLE_REGION_H

#include "contacts/whole_depth.h"

// Edges of one mesh.
typedef struct {
  uint count;
  uint edge[OX_MANY];
} ox_edge_set;

// In ascending order, so that of too many the first are kept, in whatever order they come.
static inline void ox_add_edge(ox_edge_set* set, uint edge) {
  uint place = set->count;
  while (place != 0u && set->edge[place - 1u] > edge) --place;
  if (place == OX_MANY || (place != 0u && set->edge[place - 1u] == edge)) return;
  if (set->count < OX_MANY) ++set->count;
  for (uint i = set->count - 1u; i > place; --i) set->edge[i] = set->edge[i - 1u];
  set->edge[place] = edge;
}

// The edges of mesh `side` at a feature.
static inline void ox_add_edges_at(const ox_region_view* r, uint side, __global const ox_feature* f,
                                   ox_edge_set* set) {
  const ox_scene* scene = r->scene;
  if (ox_is_vertex(f->flags)) {
    __global const ox_mesh* mesh = ox_mesh_of(scene, scene->pairs + r->pair, side);
    for (uint k = scene->ring_starts[f->source]; k < scene->ring_starts[f->source + 1u]; ++k)
      if (!ox_is_flat_edge(mesh, scene->rings[k].edge)) ox_add_edge(set, scene->rings[k].edge);
  } else if (ox_side_of(f->flags) == side) {
    ox_add_edge(set, f->source);
  } else {
    for (uint k = 0u; k < 3u; ++k) {
      const uint at = ox_side_of_triangle(scene->surfaces.triangles + f->triangle, k);
      if (ox_is_edge(at)) ox_add_edge(set, at);
    }
  }
}

// How far the members that are points of mesh `side` reach along a direction [m].
static inline float ox_farthest_along(const ox_region_view* r, uint side, float3 direction) {
  float farthest = -INFINITY;
  for (uint block = 0u; OX_VECTOR_WIDTH * block < r->count; ++block) {
    float least, most;
    ox_extent_of_block(r, block, side, direction, &least, &most);
    farthest = ox_max(farthest, most);
  }
  return farthest;
}

// A bit for each of a block of them that is so far along it.
static inline uint ox_members_beyond(const ox_region_view* r, uint block, uint side,
                                     float3 direction, float limit) {
  ox_floats along;
  ox_ints is_other;
  ox_dot_fields(&r->members, OX_MEMBER_POSITION, block, direction, &along);
  ox_others_of_block(r, block, side, &is_other);
  const ox_ints is_beyond = along >= limit;
  return ox_mask_of(&is_beyond) & ~ox_mask_of(&is_other) & ox_present_lanes(r->count, block);
}

// Those of mesh `side` at what of it in the region is farthest past a plane, to within what is not
// known of two coordinates.
static inline void ox_add_farthest(const ox_region_view* r, uint side, float3 normal,
                                   ox_edge_set* set) {
  const float3 past = -ox_way_of(side, normal);
  const uint blocks = (r->count + OX_VECTOR_WIDTH - 1u) / OX_VECTOR_WIDTH;
  const float farthest =
      ox_farthest_along(r, side, past) - OX_INFLATION * r->scene->pairs[r->pair].epsilon;
  for (uint block = 0u; block < blocks; ++block)
    for (uint far = ox_members_beyond(r, block, side, past, farthest); far != 0u; far &= far - 1u)
      ox_add_edges_at(r, side, ox_feature_of(r, OX_VECTOR_WIDTH * block + ox_lowest(far)), set);
}

static inline bool ox_are_at_facet(const ox_scene* scene, uint first, uint second, uint facet) {
  return ox_facet_of(scene, first) == facet ||
         (second != OX_NONE && ox_facet_of(scene, second) == facet);
}

// The edges of the facet of a triangle, as far as a walk over few of its triangles finds them: a
// quad has two. With many the bowl of a thousand objects took a quarter longer, and no contact that
// is measured was truer.
static inline void ox_add_rim_near(const ox_region_view* r, uint triangle, ox_edge_set* set) {
  uint walked[OX_FEW];
  walked[0] = triangle;
  uint count = 1u;
  for (uint i = 0u; i < count; ++i)
    for (uint k = 0u; k < 3u; ++k) {
      const uint at = ox_side_of_triangle(r->scene->surfaces.triangles + walked[i], k);
      if (ox_is_edge(at)) ox_add_edge(set, at);
      if (ox_is_edge(at) || at == OX_NONE) continue;
      const uint next = at & ~OX_WITHIN_FACET;
      uint known = 0u;
      while (known < count && walked[known] != next) ++known;
      if (known == count && count < OX_FEW) walked[count++] = next;
    }
}

// The next edge at a feature that is of a facet, from place `i` on; OX_NONE: there is none.
static inline uint ox_next_at_facet(const ox_region_view* r, __global const ox_feature* f,
                                    uint facet, uint* i) {
  const ox_scene* scene = r->scene;
  if (!ox_is_vertex(f->flags))
    return (*i)++ == 0u && ox_are_at_facet(scene, f->at[0], f->at[1], facet) ? f->source : OX_NONE;
  __global const ox_mesh* mesh = ox_mesh_of(scene, scene->pairs + r->pair, ox_side_of(f->flags));
  const uint start = scene->ring_starts[f->source];
  const uint count = scene->ring_starts[f->source + 1u] - start;
  while (*i < count) {
    const uint edge = scene->rings[start + (*i)++].edge;
    if (!ox_is_flat_edge(mesh, edge) && ox_are_at_facet(scene, scene->edges[edge].triangle[0],
                                                        scene->edges[edge].triangle[1], facet))
      return edge;
  }
  return OX_NONE;
}

// The edges of the facet of a triangle: those near it, and those at features.
static inline void ox_add_rim(const ox_region_view* r, uint side, uint triangle, ox_edge_set* set) {
  const uint facet = ox_facet_of(r->scene, triangle);
  ox_add_rim_near(r, triangle, set);
  for (uint first = 0u; first < r->count; first += OX_ITEMS) {
    const uint k = first + OX_ITEM;
    const bool is_of_side = k < r->count && ox_side_of(ox_flags_of(r, k)) == side;
    uint i = 0u;
    uint edge = is_of_side ? ox_next_at_facet(r, ox_feature_of(r, k), facet, &i) : OX_NONE;
    for (;;) {
      uint left = ox_group_bits(edge != OX_NONE);
      if (left == 0u) break;
      for (; left != 0u; left &= left - 1u) ox_add_edge(set, ox_of_item(edge, ox_lowest(left)));
      if (edge != OX_NONE) edge = ox_next_at_facet(r, ox_feature_of(r, k), facet, &i);
    }
  }
}

// From a plane to the best of those next to it on the map of directions (Gauss): the edges of its
// face, or its own, with the edges at what is farthest past it, and the faces at those edges. Of
// what is just below its ground that is as far as the border, past which it would go down.
// False: none is better.
static inline bool ox_walk_on(const ox_region_view* r, ox_search* search, ox_plane_choice* best) {
  __global const ox_found* found = r->scene->found + r->pair;
  if ((found->is_below[0] | found->is_below[1]) != 0u) return false;
  const ox_plane from = best->plane;
  for (uint side = 0u; side < 2u; ++side) {
    if (!ox_clears_side(&from, side)) continue;
    ox_edge_set own, past;
    own.count = past.count = 0u;
    if (from.kind == OX_PLANE_EDGES)
      own.edge[own.count++] = from.id[1u - side];
    else
      ox_add_rim(r, 1u - side, from.id[0], &own);
    ox_add_farthest(r, side, from.normal, &past);
    ox_ridge others[OX_MANY];
    for (uint k = 0u; k < past.count; ++k)
      others[k] = ox_ridge_of(r->scene, r->pair, side, past.edge[k]);
    for (uint i = 0u; i < own.count; ++i) {
      const ox_ridge ridge = ox_ridge_of(r->scene, r->pair, 1u - side, own.edge[i]);
      for (uint k = 0u; k < past.count; ++k) {
        const float limit = best->judged;  // that it is compared by is no less
        const ox_plane plane =
            side == 0u ? ox_plane_of_ridges(r->scene, r->pair, &others[k], &ridge, limit)
                       : ox_plane_of_ridges(r->scene, r->pair, &ridge, &others[k], limit);
        ox_try_whole(r, &plane, search, best);
      }
      if (!ox_parts_by_faces_of(r->scene, r->pair, r->flags, 1u - side)) continue;
      for (uint k = 0u; k < 2u; ++k) {
        if (ridge.face[k] == OX_NONE ||
            (from.kind != OX_PLANE_EDGES &&
             ox_facet_of(r->scene, ridge.face[k]) == ox_facet_of(r->scene, from.id[0])))
          continue;
        const ox_plane plane = ox_plane_of_face(r->scene, r->pair, 1u - side, ridge.face[k]);
        ox_try_whole(r, &plane, search, best);
      }
    }
  }
  return !ox_is_same_plane(&best->plane, &from);
}

// What a plane costs is least in several directions at once, as a box is thin in three: from the
// best in each the best next to it is looked for.
static inline ox_plane_choice ox_search_whole(const ox_region_view* r, ox_search* search) {
  ox_plane_choice best[OX_DIRECTIONS];
  for (uint i = 0u; i < OX_DIRECTIONS; ++i) best[i] = ox_no_choice();
  search->least = INFINITY;
  for (uint i = 0u; i < r->plane_count; ++i) {
    const ox_plane plane = ox_load_plane(&r->planes, i);
    ox_plane_choice* of_direction = best + ox_direction_of(plane.normal);
    if (ox_try_whole(r, &plane, search, of_direction))
      ox_words_of(&r->planes, OX_PLANE_FLAGS)[i] |= OX_PLANE_PASSED;  // each of a group the same
    search->least = ox_min(search->least, of_direction->judged);
  }
  ox_plane_choice least = ox_no_choice();
  for (uint i = 0u; i < OX_DIRECTIONS; ++i)
    if (ox_is_better_choice(best + i, &least)) least = best[i];
  const float worth = OX_WORTH * least.judged;
  for (uint i = 0u; i < OX_DIRECTIONS; ++i) {
    if (best[i].plane.kind == OX_PLANE_NONE || !(best[i].judged <= worth)) continue;
    bool goes_on = true;
    while (goes_on) {
      // Where it meets one that another walk ended at, it is there already.
      for (uint k = 0u; k < i && goes_on; ++k)
        goes_on = !ox_is_same_plane(&best[k].plane, &best[i].plane);
      goes_on = goes_on && ox_walk_on(r, search, best + i);
    }
    if (ox_is_better_choice(best + i, &least)) least = best[i];
  }
  return least;
}

// Of the members that are points of mesh `side` the farthest past a plane; OX_NONE: there is none,
// as of what contains the other mesh.
static inline uint ox_find_farthest(const ox_region_view* r, uint side, float3 normal) {
  const float3 past = -ox_way_of(side, normal);
  const float farthest = ox_farthest_along(r, side, past);
  uint best = OX_NONE;
  for (uint block = 0u; OX_VECTOR_WIDTH * block < r->count; ++block)
    best = ox_first_of(r, block, ox_members_beyond(r, block, side, past, farthest), best);
  return best;
}

// Where a body goes on beyond its region the faces at features may be far from the nearest: of
// those that vertices inside and the middles of chords are behind the nearest are tried too, and
// where that does not separate, the one on the other side of the body.
static inline void ox_try_nearest(const ox_region_view* r, ox_search* search,
                                  ox_plane_choice* best) {
  if (!best->of_body) return;
  const float bound = best->judged;  // the same for all, in whatever order they come
  for (uint k = 0u; k < r->count; ++k) {
    const uint flags = ox_flags_of(r, k);
    const uint side = ox_side_of(flags);
    if ((flags & OX_MEMBER_BEGINS) == 0u ||
        !ox_parts_by_faces_of(r->scene, r->pair, r->flags, 1u - side))
      continue;
    const float3 middle = ox_middle_of(r, k);
    const ox_plane nearest = ox_nearest_behind(r, side, middle, bound);
    ox_try_whole(r, &nearest, search, best);
    for (uint i = 0u; i < search->refused.count; ++i) {
      const ox_plane opposite =
          ox_face_along(r, side, middle, -ox_way_of(side, search->refused.normal[i]));
      ox_try_whole(r, &opposite, search, best);
    }
  }
}

// Whether one of the meshes is open. Behind it there is no end: what goes through it is past all of
// it, and not out.
static inline bool ox_is_on_open(const ox_region_view* r) {
  return (ox_target_of(r, 0u)->flags & ox_target_of(r, 1u)->flags & OX_MESH_CLOSED) == 0u;
}

// Whether what of a body goes first or last stays inside the other where a plane takes it. A
// crossing says nothing: it is on the surface, and where it goes along a wall it stays on it. A
// face of a body may take it through an open mesh, so what of it is behind that is asked as well.
static inline bool ox_whole_stays(const ox_region_view* r, const ox_plane_choice* choice) {
  for (uint side = 0u; side < 2u; ++side) {
    const bool clears = ox_clears_side(&choice->plane, side);
    if (!clears && (ox_target_of(r, side)->flags & OX_MESH_CLOSED) != 0u) continue;
    for (uint end = 0u; end < 2u; ++end) {
      const float3 normal = end == 0u ? choice->plane.normal : -choice->plane.normal;
      const uint k = ox_find_farthest(r, side, normal);
      if (k != OX_NONE && (clears || ox_is_vertex(ox_flags_of(r, k))) &&
          ox_stays_inside(r, side, ox_middle_of(r, k), &choice->plane, choice->depth))
        return true;
    }
  }
  return false;
}

// Whether all of a body would have to pass a plane for which the region alone would go much less
// far, and it is not far to the surface from anything of the region. Of convex bodies that is the
// least translation that separates them. Of others, other parts may block it, as where the edge of
// one lobe cuts that of another, and nothing of what overlaps tells how they part.
static inline bool ox_goes_too_far(const ox_region_view* r, const ox_plane_choice* choice) {
  if (!choice->all_of_body ||
      (ox_target_of(r, 0u)->flags & ox_target_of(r, 1u)->flags & OX_MESH_CONVEX) != 0u)
    return false;
  const float worth = choice->judged / OX_WORTH;
  for (uint k = 0u; k < r->count; ++k) {
    const uint flags = ox_flags_of(r, k);
    if ((flags & OX_MEMBER_BEGINS) != 0u &&
        ox_nearest_behind(r, ox_side_of(flags), ox_middle_of(r, k), worth).kind == OX_PLANE_NONE)
      return false;
  }
  return true;
}

// The diagonal of the box of the members [m].
static inline float ox_size_of(const ox_region_view* r) {
  float size[3];
  for (uint axis = 0u; axis < 3u; ++axis) {
    ox_floats lo = (ox_floats)(INFINITY);
    ox_floats hi = (ox_floats)(-INFINITY);
    for (uint block = 0u; OX_VECTOR_WIDTH * block < r->count; ++block) {
      const ox_floats p = OX_LOAD_FLOATS(&r->members, OX_MEMBER_POSITION + axis, block);
      const ox_ints left = (int)(r->count - OX_VECTOR_WIDTH * block) - OX_LANE_NUMBERS;
      lo = left > 0 && p < lo ? p : lo;
      hi = left > 0 && p > hi ? p : hi;
    }
    size[axis] = ox_greatest_of(&hi) - ox_least_of(&lo);
  }
  return sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]);
}

// [m] how far a region of this size may lie past the plane of a face of a mesh that is convex in
// it: what a plane clears may be above it, a facet is not quite flat, and rounding turns a sliver.
static inline float ox_flat_of(const ox_region_view* r, const ox_plane* plane, float size) {
  __global const ox_triangle* t = r->scene->surfaces.triangles + plane->id[0];
  const float3 ab = ox_corner(t, 1u) - ox_corner(t, 0u);
  const float3 ac = ox_corner(t, 2u) - ox_corner(t, 0u);
  const float3 bc = ac - ab;
  const float length2 = ox_max(ox_dot(ab, ab), ox_max(ox_dot(ac, ac), ox_dot(bc, bc)));
  const float3 normal = ox_plain_cross(ab, ac) / sqrt(length2);
  const float height = sqrt(ox_dot(normal, normal));
  const float epsilon = r->scene->pairs[r->pair].epsilon;
  return OX_CLEARANCE * epsilon + size * (OX_FACET_ANGLE + epsilon / height);
}

// Whether a face that part of a region is past costs no more than the least plane that is found:
// then the surfaces are not convex there, whether or not an edge says so. Parts of a mesh may meet
// where they have no edge in common, and in a trough of many strips no edge shows.
static inline bool ox_has_valley(const ox_region_view* r, ox_search* search,
                                 const ox_plane_choice* least) {
  float size = -1.0f;
  const ox_limits limits = {INFINITY, least->judged};
  for (uint block = 0u; OX_VECTOR_WIDTH * block < r->plane_count; ++block) {
    uint passed = ox_of_kind(&r->planes, block, OX_PLANE_PASSED, OX_PLANE_PASSED) &
                  ox_present_lanes(r->plane_count, block);
    for (; passed != 0u; passed &= passed - 1u) {
      if (size < 0.0f) size = ox_size_of(r);
      const ox_plane plane = ox_load_plane(&r->planes, OX_VECTOR_WIDTH * block + ox_lowest(passed));
      ox_kept_blocks* kept = search->kept + ox_direction_of(plane.normal);
      ox_extent extent = ox_begin_extent(&plane);
      if (ox_least_depth(r, &limits, kept, &extent) == INFINITY) continue;
      const float depth = ox_whole_depth(r, &limits, kept, &extent);
      if (depth != INFINITY && extent.past > ox_flat_of(r, &plane, size) &&
          ox_go_on_beyond(r, &plane, depth, least->judged).price <= least->judged)
        return true;
    }
  }
  return false;
}

// The least plane; OX_PLANE_NONE: there is none, or a valley. Where one does not separate the
// bodies, the way along its normal is past all of both; what takes more than twice as much is none
// either: the region meets a corner of which one plane is not all.
static inline ox_plane_choice ox_choose_whole(const ox_region_view* r) {
  ox_search search;
  for (uint i = 0u; i < OX_DIRECTIONS; ++i) search.kept[i].found[0] = search.kept[i].found[1] = 0u;
  ox_plane_choice of_body = ox_no_choice();
  float worth = INFINITY;
  search.refused.count = 0u;
  while (search.refused.count < OX_FEW) {
    ox_plane_choice best = ox_search_whole(r, &search);
    // Before the nearest faces, which take a walk for each member.
    if (search.refused.count == 0u && (r->flags & OX_REGION_CROSSED) != 0u &&
        ox_has_valley(r, &search, &best))
      return ox_no_choice();
    ox_try_nearest(r, &search, &best);
    if (best.plane.kind == OX_PLANE_NONE || !ox_is_better_choice(&best, &of_body)) break;
    if (best.judged > worth || ox_goes_too_far(r, &best)) return ox_no_choice();
    // Of what is wholly inside the planes of the other are not known all round.
    if ((r->flags & OX_REGION_CROSSED) == 0u || ox_only_touches(r, &best) ||
        !ox_whole_stays(r, &best))
      return best;
    ox_refuse(&search.refused, &best.plane);
    if (search.refused.count == 1u) worth = OX_WORTH * best.judged;
    best.judged = ox_max(best.judged, ox_depth_of_both(r, best.plane.normal));
    ox_plane_choice past = best;
    past.depth = best.judged;
    if (ox_is_better_choice(&best, &of_body) && !(ox_is_on_open(r) && ox_whole_stays(r, &past)))
      of_body = best;
  }
  return of_body.judged <= worth ? of_body : ox_no_choice();
}

#endif
