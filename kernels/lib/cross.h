// SPDX-License-Identifier: BSD-3-Clause
// The edges of one meshlet against the triangles of another, of meshes in general position. Device
// only.
#ifndef ODE_EXT_KERNELS_LIB_CROSS_H
#define ODE_EXT_KERNELS_LIB_CROSS_H

#include "lib/flooded.h"
#include "lib/intersect.h"
#include "lib/sheet_side.h"

#define OX_NEW_LEAVES 1u
#define OX_NEW_LINKED 2u  // from the pair's head on: of a side that is flooded, and with a sheet
#define OX_NEW_OPEN 4u    // of an open mesh

// Crossings of a pair that are yet to be stored.
typedef struct {
  const ox_scene* scene;
  uint pair;
  uint count;
  uint flags[OX_MOST_AT_ONCE];  // OX_NEW_..., and the side above them
  uint edge[OX_MOST_AT_ONCE];
  uint triangle[OX_MOST_AT_ONCE];
  float t[OX_MOST_AT_ONCE];
  float blur[OX_MOST_AT_ONCE];
} ox_new_crossings;
#define OX_NEW_SIDE_SHIFT 3u

static inline void ox_store_crossings(ox_new_crossings* fresh) {
  if (fresh->count == 0u) return;
  uint stored;
  const uint first = ox_append_many(fresh->scene, OX_LIST_CROSSINGS, fresh->count, &stored);
  __global ox_found* found = fresh->scene->found + fresh->pair;
  uint head[2] = {OX_NONE, OX_NONE};
  uint tail[2] = {OX_NONE, OX_NONE};
  bool at_border[2] = {false, false};
  for (uint i = 0u; i < stored; ++i) {
    const uint flags = fresh->flags[i];
    const uint side = flags >> OX_NEW_SIDE_SHIFT;
    __global ox_edge_crossing* crossing = fresh->scene->crossings + first + i;
    crossing->pair_side = fresh->pair << 1 | side;
    crossing->edge = fresh->edge[i];
    crossing->triangle = fresh->triangle[i];
    crossing->t = fresh->t[i];
    crossing->blur = fresh->blur[i];
    crossing->leaves = flags & OX_NEW_LEAVES;
    if ((flags & OX_NEW_LINKED) == 0u) continue;
    if (head[side] == OX_NONE) tail[side] = first + i;
    crossing->before = head[side];
    head[side] = first + i;
    if ((flags & OX_NEW_OPEN) != 0u)
      at_border[side] |= fresh->scene->edges[fresh->edge[i]].triangle[1] == OX_NONE;
  }
  for (uint side = 0u; side < 2u; ++side)
    if (at_border[side]) ox_exchange(fresh->scene, &found->at_border[side], 1u);
  for (uint side = 0u; side < 2u; ++side)
    if (head[side] != OX_NONE)
      fresh->scene->crossings[tail[side]].before =
          ox_exchange(fresh->scene, &found->head[side], head[side]);
  fresh->count = 0u;
}

static inline void ox_add_crossing(ox_new_crossings* fresh, uint side, uint edge, uint triangle,
                                   float t, float blur, uint flags) {
  const uint i = fresh->count++;
  fresh->flags[i] = flags | side << OX_NEW_SIDE_SHIFT;
  fresh->edge[i] = edge;
  fresh->triangle[i] = triangle;
  fresh->t[i] = t;
  fresh->blur[i] = blur;
  if (fresh->count == OX_MOST_AT_ONCE) ox_store_crossings(fresh);
}

// What rounding may have moved a determinant by is so much of the sum of what its six terms are
// without their signs: five roundings of each, of which 8 are taken.
#define OX_TERMS_ROUNDING 0x1p-21f
static inline float ox_terms_of(float3 u, float3 v, float3 p) {
  const float3 a = fabs(u);
  const float3 b = fabs(v);
  return ox_dot(a.yzx * b.zxy + a.zxy * b.yzx, fabs(p));
}

// How far along an edge triangle k crosses it [m]. By its corners from the first on, in order of
// their places: the same bits for each triangle that has these corners. *blur [m]: what rounding
// may have moved it; where the edge runs along the plane that is far.
static inline float ox_place_of_crossing(float3 from, float3 to, const ox_general_triangles* t,
                                         uint k, float* blur) {
  uint first = 0u;
  for (uint corner = 1u; corner < 3u; ++corner) {
    const float3 one = ox_general_corner(t, corner, k);
    const float3 other = ox_general_corner(t, first, k);
    if (one.x < other.x ||
        (one.x == other.x && (one.y < other.y || (one.y == other.y && one.z < other.z))))
      first = corner;
  }
  const float3 a = ox_general_corner(t, first, k);
  const float3 u = ox_general_corner(t, (first + 1u) % 3u, k) - a;
  const float3 v = ox_general_corner(t, (first + 2u) % 3u, k) - a;
  const float3 n = ox_plain_cross(u, v);
  const float3 d = to - from;
  const float length = sqrt(ox_dot(d, d));
  const float3 p = from - a;
  const float3 q = to - a;
  const float above = ox_dot(n, p);
  const float along = above - ox_dot(n, q);
  const float doubt = OX_TERMS_ROUNDING * ox_max(ox_terms_of(u, v, p), ox_terms_of(u, v, q));
  // Both heights are off by as much. Where they are 0 the edge lies in the plane: anywhere on it.
  *blur = fabs(along) > 2.0f * doubt ? ox_min(2.0f * doubt / fabs(along), 1.0f) * length : length;
  const float part = along != 0.0f ? ox_min(ox_max(above / along, 0.0f), 1.0f) : 0.5f;
  return part * length;
}

// The edges of a meshlet that may cross the other one: a bit for each of those with even numbers,
// and of those with odd ones. And their ends, a bit for each vertex, perhaps the first beside them.
typedef struct {
  uint edges[2];
  uint ends;
} ox_near_edges;

// The vertices at either end of a block of the edges with even numbers, or of those with odd ones.
static inline void ox_load_ends(__global const ox_meshlet* meshlet, uint block, uint odd,
                                ox_ints* p, ox_ints* q) {
  const ox_ints ends = ox_load_ints(block, meshlet->ends);
  *p = ends >> (int)OX_END_SHIFT(odd, 0u) & 255;
  *q = ends >> (int)OX_END_SHIFT(odd, 1u) & 255;
}

static inline ox_near_edges ox_find_near_edges(__global const ox_meshlet* source,
                                               const ox_general_points* points) {
  ox_near_edges near = {{0u, 0u}, 0u};
  const ox_ints one = 1;
  const ox_ints none = 0;
  for (uint block = 0u; block < OX_BLOCKS; ++block) {
    for (uint odd = 0u; odd < 2u; ++odd) {
      ox_ints p, q;
      ox_load_ends(source, block, odd, &p, &q);
      ox_ints beyond_p, beyond_q;
      ox_pick_ints(points->beyond, &p, &beyond_p);
      ox_pick_ints(points->beyond, &q, &beyond_q);
      const ox_ints is_near = (beyond_p & beyond_q) == 0;
      const uint present = ox_present_lanes((source->edge_count + 1u - odd) / 2u, block);
      near.edges[odd] |= (ox_mask_of(&is_near) & present) << (OX_VECTOR_WIDTH * block);
      const ox_ints bits = is_near ? one << p | one << q : none;
      near.ends |= as_uint(OX_FOLD(bits, OX_OR));
    }
  }
  return near;
}

// Of the vertices of a meshlet, a bit for each triangle of the other one: ox_heights.
typedef struct {
  int above[OX_LANES], doubt[OX_LANES];
} ox_end_heights;

static inline void ox_clear_heights(ox_end_heights* heights) {
  const ox_ints none = 0;
  for (uint block = 0u; block < OX_BLOCKS; ++block) {
    ox_store_ints(none, block, heights->above);
    ox_store_ints(none, block, heights->doubt);
  }
}

// Of the edges of a meshlet that are near those whose ends are, perhaps, on either side of one of
// some triangles: a bit for each with an even number, and for each with an odd one.
static inline void ox_edges_through(__global const ox_meshlet* source, const ox_near_edges* near,
                                    const ox_end_heights* heights, uint triangles,
                                    uint through[2]) {
  through[0] = through[1] = 0u;
  for (uint block = 0u; block < OX_BLOCKS; ++block) {
    for (uint odd = 0u; odd < 2u; ++odd) {
      ox_ints p, q;
      ox_load_ends(source, block, odd, &p, &q);
      ox_ints above_p, above_q, doubt_p, doubt_q;
      ox_pick_ints(heights->above, &p, &above_p);
      ox_pick_ints(heights->above, &q, &above_q);
      ox_pick_ints(heights->doubt, &p, &doubt_p);
      ox_pick_ints(heights->doubt, &q, &doubt_q);
      const ox_ints asked = ((above_p ^ above_q) | doubt_p | doubt_q) & as_int(triangles);
      const ox_ints is_through = asked != 0;
      through[odd] |= ox_mask_of(&is_through) << (OX_VECTOR_WIDTH * block);
    }
  }
  through[0] &= near->edges[0];
  through[1] &= near->edges[1];
}

// The triangles of a meshlet that may cross the other one, of some blocks of its lanes.
static inline uint ox_find_near_triangles(__global const ox_meshlet* target,
                                          const ox_general_points* points, ox_block_range blocks) {
  uint near = 0u;
  for (uint block = blocks.first; block < blocks.end; ++block) {
    ox_ints beyond = -1;
    for (uint corner = 0u; corner < 3u; ++corner) {
      ox_ints lanes, of_corner;
      ox_places_of_corner(target, block, corner, &lanes);
      ox_pick_ints(points->beyond, &lanes, &of_corner);
      beyond &= of_corner;
    }
    const ox_ints is_near = beyond == 0;
    near |= (ox_mask_of(&is_near) & ox_present_lanes(target->triangle_count, block))
            << (OX_VECTOR_WIDTH * block);
  }
  return near;
}

// A meshlet of a pair in general position, and its triangles once they are asked about.
typedef struct {
  uint meshlet;  // over all meshes
  ox_general_points points;
  ox_box box;
  ox_slab slab;
  bool is_far;  // it does not meet the other mesh (lib/bases.h)
  bool has_triangles;
  ox_general_triangles triangles;
  ox_general_planes planes;
} ox_placed_meshlet;

// Two of a pair. Of the pairs of meshlets that come one after the other most have one in common,
// which stays.
typedef struct {
  uint pair;  // OX_NONE: none yet
  ox_placed_meshlet of[2];
} ox_placed_meshlets;

static inline void ox_place_meshlet(const ox_scene* scene, uint p, uint side, uint meshlet,
                                    ox_placed_meshlet* placed) {
  __global const ox_pair* pair = scene->pairs + p;
  __global const ox_meshlet* m = scene->surfaces.meshlets + meshlet;
  placed->meshlet = meshlet;
  placed->has_triangles = false;
  ox_place_generally(pair, side, m, &placed->points);
  if (side == 0u) {
    placed->box = ox_box_of_points(&placed->points);
    placed->slab = ox_slab_there(pair, 0u, m, pair->margin);
  } else {
    // The grid moves them by less.
    placed->box.lo = ox_from_base(pair, 1u, vload3(0, m->lo)) - pair->epsilon;
    placed->box.hi = ox_from_base(pair, 1u, vload3(0, m->hi)) + pair->epsilon;
    placed->slab = ox_slab_of(pair, m);
  }
  const float largest = ox_largest_of(pair->snap);
  const float3 far = OX_GREATER(placed->box.hi, -placed->box.lo);
  placed->is_far = OX_GREATER(OX_GREATER(far.x, far.y), far.z) > largest;
  const float to_base = ox_dot(placed->slab.normal, ox_base(pair, 1u));
  placed->slab.lo -= to_base;
  placed->slab.hi -= to_base;
}

// False: they lie apart.
static inline bool ox_place_meshlets(const ox_scene* scene, const ox_meshlet_pair* both,
                                     ox_placed_meshlets* placed) {
  for (uint side = 0u; side < 2u; ++side)
    if (placed->pair != both->pair || placed->of[side].meshlet != both->meshlet[side])
      ox_place_meshlet(scene, both->pair, side, both->meshlet[side], &placed->of[side]);
  placed->pair = both->pair;
  ox_placed_meshlet* a = &placed->of[0];
  ox_placed_meshlet* b = &placed->of[1];
  if (a->is_far || b->is_far) return false;
  return ox_note_beyond(&a->points, &b->box, &b->slab) &&
         ox_note_beyond(&b->points, &a->box, &a->slab);
}

static inline void ox_place_triangles(__global const ox_meshlet* meshlet, ox_block_range blocks,
                                      ox_placed_meshlet* placed) {
  if (placed->has_triangles) return;
  placed->has_triangles = true;
  ox_gather_triangles(meshlet, &placed->points, blocks, &placed->triangles);
  ox_make_planes(&placed->triangles, blocks, &placed->planes);
}

// Where the edges of the meshlet of one side cross the triangles of the other, those of some blocks
// of its lanes. `reach`: as in ox_heights_over.
static inline void ox_intersect_side(ox_new_crossings* fresh, uint side, ox_placed_meshlets* placed,
                                     float reach, ox_block_range blocks) {
  const ox_scene* scene = fresh->scene;
  __global const ox_pair* pair = scene->pairs + fresh->pair;
  __global const ox_meshlet* source = scene->surfaces.meshlets + placed->of[side].meshlet;
  __global const ox_meshlet* target = scene->surfaces.meshlets + placed->of[1u - side].meshlet;
  const ox_general_points* points = &placed->of[side].points;
  const ox_near_edges near = ox_find_near_edges(source, points);
  if ((near.edges[0] | near.edges[1]) == 0u) return;
  ox_placed_meshlet* faces = &placed->of[1u - side];
  const uint near_triangles = ox_find_near_triangles(target, &faces->points, blocks);
  if (near_triangles == 0u) return;
  __global const ox_mesh* mesh = scene->meshes + pair->mesh[side];
  const bool is_linked = ox_is_flooded(scene, mesh, scene->meshes + pair->mesh[1u - side]) ||
                         ox_sheet_of(scene, pair) != OX_NONE;
  const uint flags =
      (is_linked ? OX_NEW_LINKED : 0u) | ((mesh->flags & OX_MESH_CLOSED) == 0u ? OX_NEW_OPEN : 0u);
  ox_place_triangles(target, blocks, faces);
  const ox_general_triangles* t = &faces->triangles;
  ox_end_heights heights;
  ox_clear_heights(&heights);
  for (uint asked = near.ends; asked != 0u; asked &= asked - 1u) {
    const uint v = ox_lowest(asked);
    const ox_heights over =
        ox_heights_over(t, &faces->planes, blocks, reach, ox_general_point(points, v));
    heights.above[v] = as_int(over.above);
    heights.doubt[v] = as_int(over.doubt);
  }
  uint left[2];
  ox_edges_through(source, &near, &heights, near_triangles, left);
  while ((left[0] | left[1]) != 0u) {
    const uint odd = left[0] == 0u ? 1u : 0u;
    const uint e = 2u * ox_lowest(left[odd]) + odd;
    left[odd] &= left[odd] - 1u;
    const uint p = OX_END(source->ends, e, 0u);
    const uint q = OX_END(source->ends, e, 1u);
    const uint doubt = as_uint(heights.doubt[p] | heights.doubt[q]);
    const uint asked_of = (as_uint(heights.above[p] ^ heights.above[q]) | doubt) & near_triangles;
    const float3 from = ox_general_point(points, p);
    const float3 to = ox_general_point(points, q);
    const ox_passes passes = ox_passes_of(t, blocks, reach, from, to - from);
    const uint out = as_uint(heights.above[q]);  // where that is sure
    const uint sure = asked_of & ~doubt & ((out & passes.left) | (~out & passes.right));
    uint met = asked_of &
               (((out | doubt) & passes.perhaps_left) | ((~out | doubt) & passes.perhaps_right));
    if ((met & ~sure) != 0u) met &= ox_boxes_met(t, blocks, from, to);
    for (; met != 0u; met &= met - 1u) {
      const uint k = ox_lowest(met);
      const float3 a = ox_general_corner(t, 0u, k);
      uint way = (out >> k & 1u) != 0u ? OX_CROSSING_OUT : OX_CROSSING_IN;
      if ((sure >> k & 1u) == 0u)
        way = ox_cross_exactly(pair, side, from, to, a, ox_general_corner(t, 1u, k),
                               ox_general_corner(t, 2u, k));
      if (way == OX_NO_CROSSING) continue;
      float blur;
      const float place = ox_place_of_crossing(from, to, t, k, &blur);
      ox_add_crossing(fresh, side, source->edge[e], target->triangle[k], place, blur,
                      flags | (way == OX_CROSSING_OUT ? OX_NEW_LEAVES : 0u));
    }
  }
}

// The edges of the meshlets of `sides` of two against the triangles of the other one, those of some
// blocks of its lanes, the same in every call with `placed`.
static inline void ox_cross_sides(const ox_scene* scene, const ox_meshlet_pair* both,
                                  uint first_side, uint end_side, ox_block_range blocks,
                                  ox_placed_meshlets* placed) {
  if (!ox_place_meshlets(scene, both, placed)) return;
  const float reach = ox_reach_of(&placed->of[0].box, &placed->of[1].box);
  ox_new_crossings fresh;
  fresh.scene = scene;
  fresh.pair = both->pair;
  fresh.count = 0u;
  for (uint side = first_side; side < end_side; ++side)
    ox_intersect_side(&fresh, side, placed, reach, blocks);
  ox_store_crossings(&fresh);
}

// The edges of either meshlet against the triangles of the other, by one work-item.
static inline void ox_cross_meshlets(const ox_scene* scene, const ox_meshlet_pair* both,
                                     ox_placed_meshlets* placed) {
  ox_cross_sides(scene, both, 0u, 2u, OX_ALL_BLOCKS, placed);
}

#endif
