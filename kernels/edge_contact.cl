// SPDX-License-Identifier: BSD-3-Clause
// Edge contacts: what the crossings of edges say that vertices do not. Contacts where edges meet
// edges, one at least in every region of overlap, and the way out for what is wholly inside.
//
// in    crossings, candidates of vertices, pairs, meshes, vertices, edges, triangles, meshlets,
//       meshlet_nodes, facets
// out   candidates, and per pair their number
// item  1 crossing (grid-stride); 1 pair (of a queue)
// may overflow: none; a pair has room for OX_POINTS_PER_CROSSING candidates per crossing, and the
// last points beyond that are left out: ways out of regions that have contacts already
#ifndef OX_PLANES
#include "shared/crossing_order.h"
#include "shared/deep_parts.h"
#include "shared/exit_edge.h"
#include "shared/open_target.h"
#include "shared/reconcile.h"
#include "shared/region_width.h"
#include "shared/regions.h"
#include "shared/spokesmen.h"

// in: crossings. out: those of each pair together, as they are needed, and the first of the orders
// of them. item: 1 crossing.
__kernel void crossing_gather(OX_SCENE_PARAMETERS, __global const ox_edge_crossing* crossings,
                              __global ox_pair_crossing* gathered, __global uint* order) {
  const ox_scene scene = OX_SCENE;
  const uint count = ox_length(&scene, OX_LIST_CROSSINGS);
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < count; i += stride) {
    const ox_edge_crossing crossing = crossings[i];
    if (crossing.slot == OX_NONE) continue;
    const uint p = crossing.pair_side >> 1;
    const uint side = crossing.pair_side & 1u;
    __global const ox_edge* edge = edges + crossing.edge;
    float3 a = vload3(0, vertices[edge->vertex[0]].position);
    float3 b = vload3(0, vertices[edge->vertex[1]].position);
    if (side == 0u) {
      a = ox_place(pairs + p, 0u, a);
      b = ox_place(pairs + p, 0u, b);
    }
    const float3 d = b - a;
    const float3 position = a + crossing.t * (d / sqrt(ox_dot(d, d)));
    ox_pair_crossing of_pair;
    of_pair.flags =
        (side != 0u ? OX_CROSSING_SIDE : 0u) | (crossing.leaves != 0u ? OX_CROSSING_LEAVES : 0u);
    of_pair.edge = crossing.edge;
    of_pair.triangle = crossing.triangle;
    of_pair.t = crossing.t;
    of_pair.facet = facets[crossing.triangle];
    of_pair.at[0] = facets[edge->triangle[0]];
    of_pair.at[1] = edge->triangle[1] == OX_NONE ? OX_NONE : facets[edge->triangle[1]];
    of_pair.other = OX_NONE;
    of_pair.other_t = 0.0f;
    of_pair.region = OX_NONE;
    of_pair.position[0] = position.x;
    of_pair.position[1] = position.y;
    of_pair.position[2] = position.z;
    of_pair.paired = 0.0f;
    of_pair.hit = OX_NONE;
    of_pair.padding = 0u;
    const uint first = found[p].first_crossing;
    gathered[first + crossing.slot] = of_pair;
    order[(size_t)OX_ORDERS_PER_CROSSING * first + crossing.slot] = crossing.slot;
  }
}

// A vertex in contact covers the region it is in.
static void ox_cover_by_vertices(ox_edge_pair* p) {
  if (((p->mesh[0]->flags | p->mesh[1]->flags) & OX_MESH_TWO_SIDED) != 0u) {
    // On which side of a sheet an edge is inside nobody knows.
    ox_link_hits(p, OX_BY_FIRST_VERTEX);
    ox_link_hits(p, OX_BY_SECOND_VERTEX);
    return;
  }
  for (uint side = 0u; side < 2u; ++side) {
    const ox_hit_count hits = ox_count_hits(p, side);
    if (hits.inside == 0u) continue;
    // Inside a closed target every vertex has a hit.
    const bool all = (p->mesh[1u - side]->flags & OX_MESH_CLOSED) != 0u && hits.fallback == 0u;
    for (uint i = 0u; i < p->count; ++i) {
      __global ox_pair_crossing* c = p->crossings + i;
      if (ox_side(c) != side) continue;
      if (all ? ox_inner_vertex(p, c) != OX_NONE : ox_is_inside_hit(p, c->hit))
        c->flags |= OX_CROSSING_COVERED;
    }
  }
}

// Whether the chord of c crosses a facet at the edge of `of` before c too: the pair of edges was
// looked at there.
static bool ox_was_paired(const ox_edge_pair* p, __global const ox_pair_crossing* c,
                          __global const ox_pair_crossing* of) {
  if (c->other == OX_NONE) return false;
  __global const ox_pair_crossing* other = p->crossings + c->other;
  return (other->t < c->t || (other->t == c->t && other->triangle < c->triangle)) &&
         ox_is_at_facet(of, other->facet);
}

// Contacts of an edge of A and one of B each of which crosses a facet at the other.
static void ox_pair_edges(ox_edge_pair* p) {
  for (uint k = 0u; k < p->count; ++k) {
    __global ox_pair_crossing* a = p->crossings + p->order[k];
    if (ox_side(a) != 0u) return;
    bool met = false;
    ox_wedge wedge_a;
    for (uint f = 0u; f < 2u; ++f) {
      if (a->at[f] == OX_NONE || (f == 1u && a->at[1] == a->at[0])) continue;
      const ox_crossing_key key = ox_facets_key(0u, a->at[f], a->facet);
      for (uint n = ox_first_entry(p, key); n != OX_NONE; n = ox_next_entry(p, n)) {
        __global ox_pair_crossing* b = p->crossings + (n >> 1);
        if (ox_side(b) == 0u) continue;
        if (ox_was_paired(p, a, b) || ox_was_paired(p, b, a)) continue;
        if (!met) wedge_a = ox_wedge_of(p, a);
        met = true;
        const ox_wedge wedge_b = ox_wedge_of(p, b);
        ox_point point;
        if (!ox_edge_contact(&wedge_a, &wedge_b, &point)) continue;
        a->flags |= OX_CROSSING_COVERED;
        b->flags |= OX_CROSSING_COVERED;
        a->paired = ox_max(a->paired, point.depth);
        b->paired = ox_max(b->paired, point.depth);
        ox_add_point(p, 0u, p->edges[a->edge].triangle[0], p->edges[b->edge].triangle[0], a->region,
                     point.position, point.normal, point.depth);
      }
    }
  }
}

// The middle of an edge that runs through the target, cast as if it were a vertex: where a finely
// cut target bulges over a long edge, its own edges meet that edge only at the rim, where nothing
// is deep. Only what is deeper than the contacts of edges there: those know the direction better
// (of two ridges across one another the middle would slip off to one side).
static void ox_cast_middles(ox_edge_pair* p) {
  for (uint k = 0u; k < p->count; ++k) {
    __global ox_pair_crossing* c = p->crossings + p->order[k];
    const uint side = ox_side(c);
    if (ox_leaves(c) || c->other == OX_NONE || (p->mesh[1u - side]->flags & OX_MESH_CLOSED) == 0u)
      continue;
    __global ox_pair_crossing* end = p->crossings + c->other;
    if (end->other != p->order[k]) continue;
    ox_middle middle;
    // As for vertices, not beyond where it leaves its own mesh.
    if (!ox_look_from_middle(p, c, &middle) || middle.on_surface ||
        middle.exit_t > middle.own_t + p->pair->epsilon)
      continue;
    const ox_way_out way = ox_through(p, side, middle.exit);
    const float depth = ox_depth_below(&way, middle.position);
    if (!(depth > 1.5f * ox_max(c->paired, end->paired)) || !(depth <= fabs(c->other_t - c->t)) ||
        !(depth > p->pair->epsilon) || ox_dot(way.normal, middle.inward) < 0.0f)
      continue;
    ox_add_point(p, side, p->edges[c->edge].triangle[0], middle.exit, c->region, middle.position,
                 side == 0u ? way.normal : -way.normal, depth);
  }
}

// Rays that look for a way out, per region and side: from the middles of so many chords at most.
#define OX_MOST_CHORDS 8u

static void ox_try_chord(const ox_edge_pair* p, uint region, bool vertices,
                         __global const ox_pair_crossing* c, ox_way_out* best) {
  const uint side = ox_side(c);
  // The faces at its ends are what rays along the chord would meet, were it not too short for them.
  ox_try_way(p, region, vertices, side, c->triangle, best);
  if (c->other != OX_NONE)
    ox_try_way(p, region, vertices, side, p->crossings[c->other].triangle, best);
  const float3 middle = 0.5f * (ox_chord_end(p, c, 0u) + ox_chord_end(p, c, 1u));
  const float3 along = ox_line_of(p, side, c->edge).along;
  float3 normal = (float3)(0.0f);
  for (uint k = 0u; k < 2u; ++k) {
    const uint triangle = p->edges[c->edge].triangle[k];
    if (triangle != OX_NONE) normal += ox_normal_in_b(p, side, triangle);
  }
  const float3 binormal = ox_plain_cross(along, normal);
  for (uint k = 0u; k < (c->other == OX_NONE ? 6u : 4u); ++k) {
    float3 direction = k < 2u ? normal : k < 4u ? binormal : along;
    if ((k & 1u) != 0u) direction = -direction;
    const float length2 = ox_dot(direction, direction);
    if (length2 < 1.0e-12f) continue;  // the faces at the edge are back to back
    ox_try_way(p, region, vertices, side, ox_exit_face(p, side, middle, direction / sqrt(length2)),
               best);
  }
}

static ox_way_out ox_find_way_out(const ox_edge_pair* p, uint region, bool vertices) {
  ox_way_out best = ox_no_way_out();
  uint looked[2] = {0u, 0u};
  for (uint k = p->region_first[region]; k < ox_region_end(p, region); ++k) {
    __global const ox_pair_crossing* c = p->crossings + p->by_region[k];
    if ((ox_leaves(c) && c->other != OX_NONE) || looked[ox_side(c)] == OX_MOST_CHORDS ||
        (p->mesh[1u - ox_side(c)]->flags & OX_MESH_CLOSED) == 0u)
      continue;
    ++looked[ox_side(c)];
    ox_try_chord(p, region, vertices, c, &best);
  }
  return best;
}

// Contacts for a region in a closed target: the ends of its chords, those at least half as deep as
// the deepest.
static void ox_leave_region_by(ox_edge_pair* p, uint region, bool vertices,
                               const ox_way_out* best) {
  if (best->triangle == OX_NONE) return;
  const float3 normal = best->side == 0u ? best->normal : -best->normal;
  for (uint k = p->region_first[region]; k < ox_region_end(p, region); ++k) {
    __global const ox_pair_crossing* c = p->crossings + p->by_region[k];
    // A crossing lies on both surfaces, whosever edge it is of. The far end of a chord speaks for
    // itself, and so does a vertex that knows its way out.
    const bool own = ox_side(c) == best->side;
    const uint source = own ? p->edges[c->edge].triangle[0] : c->triangle;
    const uint vertex = own ? ox_inner_vertex(p, c) : OX_NONE;
    const bool both = vertex != OX_NONE && !ox_is_inside_hit(p, c->hit);
    for (uint end = 0u; end < (both ? 2u : 1u); ++end) {
      const float3 point = ox_chord_end(p, c, end);
      const float depth = ox_depth_below(best, point);
      if (depth >= 0.5f * best->depth)
        ox_add_point(p, best->side, source, best->triangle, region, point, normal, depth);
    }
  }
  if (vertices) ox_lead_vertices_out(p, best);
}

static void ox_lead_region_out(ox_edge_pair* p, uint region, bool vertices) {
  const ox_way_out best = ox_find_way_out(p, region, vertices);
  ox_leave_region_by(p, region, vertices, &best);
}

// No region is left without a contact because its own push the other way.
static void ox_reconcile_regions(ox_edge_pair* p) {
  if (p->regions < 2u) return;
  ox_link_points(p);
  uint ordered = 0u;  // candidates by depth, and the first of those added since
  uint added = 0u;
  for (uint region = 0u; region < p->regions; ++region) {
    const uint own = ox_find_shallowest(p, region);
    if (own == OX_NONE) continue;
    // Of a region the shallowest is the likeliest to stand, and mostly does.
    uint standing = ox_find_contradictor(p, ordered, added, own);
    if (standing == OX_NONE) continue;
    if (ordered == 0u) {
      ordered = ox_order_by_depth(p->candidates, p->candidate_count, OX_HIT_INSIDE);
      added = p->candidate_count;
    }
    standing = ox_find_standing(p, ordered, added, region, standing);
    if (standing == OX_NONE ||
        !ox_are_of_different_parts(p->candidates + own, p->candidates + standing))
      continue;
    const float3 normal = vload3(0, p->candidates[standing].normal);
    const ox_way_out way = ox_find_way_along(p, region, normal);
    const uint end = p->candidate_count;
    if (way.triangle != OX_NONE && way.depth <= OX_FARTHEST_WAY * p->candidates[own].depth)
      ox_leave_region_by(p, region, false, &way);
    ox_settle_region(p, region, p->candidate_count == end);
  }
}

// How deep the deepest point of a region is below a way, or a depth beyond `limit`. `deepest`:
// where that was for another way, and so may be for this one.
static float ox_measure_to(const ox_edge_pair* p, uint region, const ox_way_out* way, float limit,
                           uint* deepest) {
  float depth = ox_max(0.0f, ox_depth_at(p, way, p->crossings + p->by_region[*deepest]));
  for (uint k = p->region_first[region]; k < ox_region_end(p, region) && depth <= limit; ++k) {
    const float here = ox_depth_at(p, way, p->crossings + p->by_region[k]);
    if (!(here > depth)) continue;
    depth = here;
    *deepest = k;
  }
  return depth;
}

// A contact for a region in an open target, where its shallowest crossing is. Nothing is known of
// what is beyond the target's thickness.
static void ox_push_region_back(ox_edge_pair* p, uint region) {
  uint best = OX_NONE;
  float best_depth = INFINITY;
  float3 best_normal = (float3)(0.0f);
  uint deepest = p->region_first[region];
  for (uint k = p->region_first[region]; k < ox_region_end(p, region); ++k) {
    const uint i = p->by_region[k];
    __global const ox_pair_crossing* c = p->crossings + i;
    const uint side = ox_side(c);
    __global const ox_mesh* target = p->mesh[1u - side];
    if ((target->flags & OX_MESH_CLOSED) != 0u) continue;
    ox_way_out way = ox_through(p, side, c->triangle);
    float depth;
    if ((target->flags & OX_MESH_TWO_SIDED) != 0u) {  // the shorter end is beyond
      const ox_line line = ox_line_of(p, side, c->edge);
      const float end = c->t < 0.5f * line.length ? 0.0f : line.length;
      depth = ox_depth_below(&way, line.from + end * line.along);
      if (depth < 0.0f) {
        depth = -depth;
        way.normal = -way.normal;
      }
    } else {
      depth = ox_measure_to(p, region, &way, ox_min(best_depth, target->reach), &deepest);
    }
    depth = ox_min(depth, target->reach);
    if (depth < best_depth) {
      best = i;
      best_depth = depth;
      best_normal = side == 0u ? way.normal : -way.normal;
    }
  }
  if (best == OX_NONE) return;
  __global const ox_pair_crossing* c = p->crossings + best;
  ox_add_point(p, ox_side(c), p->edges[c->edge].triangle[0], c->triangle, region,
               vload3(0, c->position), best_normal, best_depth);
}

static void ox_lead_regions_out(ox_edge_pair* p) {
  // Along a sheet regions cannot be told apart (its flat edges are not cast, yet its triangles are
  // facets each): edges speak only where no vertex does.
  if (((p->mesh[0]->flags | p->mesh[1]->flags) & OX_MESH_TWO_SIDED) != 0u &&
      ox_count_hits(p, 0u).inside + ox_count_hits(p, 1u).inside != 0u)
    return;
  for (uint region = 0u; region < p->regions; ++region) {
    bool covered = false;
    for (uint k = p->region_first[region]; k < ox_region_end(p, region) && !covered; ++k)
      covered = (p->crossings[p->by_region[k]].flags & OX_CROSSING_COVERED) != 0u;
    if (covered) continue;
    const uint before = p->candidate_count;
    // Where it is the only one, all vertices beyond their own exit belong to it.
    ox_lead_region_out(p, region, p->regions == 1u);
    if (p->candidate_count == before) ox_push_region_back(p, region);
  }
}

// A vertex that lies on the surface where a contact faces the same way rests there like the others:
// without it a box would stand on whichever corner rounding pushed in. 25.8 degrees, as for
// patches.
static void ox_admit_touching(const ox_edge_pair* p) {
  uint inside = 0u;
  for (uint i = 0u; i < p->candidate_count; ++i)
    if (ox_kind(p->candidates + i) == OX_HIT_INSIDE) p->candidates[inside++].ordered = i;
  uint admitting = 0u;  // what admitted the last one mostly admits the next
  uint refused = OX_NONE;
  for (uint i = 0u; i < p->candidate_count; ++i) {
    __global ox_candidate* c = p->candidates + i;
    if (ox_kind(c) != OX_HIT_TOUCHING) continue;
    const float3 normal = vload3(0, c->normal);
    if (refused != OX_NONE && all(vload3(0, p->candidates[refused].normal) == normal)) continue;
    bool admitted = false;
    for (uint k = 0u; k < inside && !admitted; ++k) {
      const uint at = admitting + k < inside ? admitting + k : admitting + k - inside;
      admitted = ox_dot(normal, vload3(0, p->candidates[p->candidates[at].ordered].normal)) > 0.9f;
      if (admitted) admitting = at;
    }
    if (admitted)
      c->side_kind = (c->side_kind & ~OX_HIT_KIND) | OX_HIT_INSIDE;
    else
      refused = i;
  }
}

// Thin parts deep in the target (a plate in a block): the vertices that know a way out, those near
// a face that the part cuts, lead the others nowhere. The face below which all of it is least deep
// does.
static void ox_lead_deep_out(ox_edge_pair* p) {
  for (uint side = 0u; side < 2u; ++side) {
    // First all are found, then led out: what leads one out may lead out others, and their order is
    // that of the hits.
    ox_mark_deep_vertices(p, side);
    ox_mark_deep_chords(p, side);
    for (uint region = 0u; region < p->regions; ++region)
      if (ox_take_mark(p, region)) ox_lead_region_out(p, region, true);
  }
}

// Where two convex bodies overlap (in one region, then) and the deepest contact does not part them
// along its normal, the least way that may becomes one: along the normal of some contact, or the
// way out of the region.
static void ox_deepen(ox_edge_pair* p) {
  if (p->regions != 1u || p->count > OX_MOST_CORNERS ||
      (p->mesh[0]->flags & p->mesh[1]->flags & OX_MESH_CLOSED) == 0u)
    return;
  const uint deepest = ox_deepest(p);
  if (deepest == OX_NONE) return;
  ox_extent extent = ox_extent_of(p, vload3(0, p->candidates[deepest].normal));
  // 10 %: less is not worth another contact.
  if (extent.high - extent.low <= 1.1f * p->candidates[deepest].depth + p->pair->epsilon ||
      !ox_is_convex(p))
    return;
  const uint narrowest = ox_narrowest(p, &extent);
  if (narrowest == OX_NONE) return;
  __global const ox_candidate* along = p->candidates + narrowest;
  const float width = extent.high - extent.low;
  const ox_way_out way = ox_find_way_out(p, 0u, true);
  if (way.triangle != OX_NONE && way.depth < width) {
    ox_leave_region_by(p, 0u, true, &way);
    return;
  }
  // The normal leads into A: what is deepest of A is lowest along it, what is of B highest.
  const uint side = (along->side_kind & OX_HIT_SIDE) != 0u ? 1u : 0u;
  const uint corner = side == 0u ? extent.lowest : extent.highest;
  if (corner == OX_NONE) return;
  __global const ox_pair_crossing* at = p->crossings + corner;
  ox_add_point(p, side, ox_side(at) == side ? p->edges[at->edge].triangle[0] : at->triangle,
               along->triangle, 0u, side == 0u ? extent.lowest_corner : extent.highest_corner,
               vload3(0, along->normal), width);
}

// Rays that look for a way out of what holds the whole mesh.
#define OX_MOST_VERTICES 64u

// Nothing crosses, yet vertices are inside: all of the mesh is, or the two coincide.
static void ox_lead_mesh_out(ox_edge_pair* p, uint side, uint fallback, uint vertex_first) {
  ox_way_out best = ox_no_way_out();
  // By their place in the mesh, which does not depend on the order of the hits.
  const uint every = (fallback + OX_MOST_VERTICES - 1u) / OX_MOST_VERTICES;
  for (uint i = 0u; i < p->candidate_count; ++i) {
    __global const ox_candidate* c = p->candidates + i;
    if (!ox_is_fallback(p, i, side) || (c->vertex - vertex_first) % every != 0u) continue;
    float3 outward = -vload3(0, p->vertices[c->vertex].direction);
    if (side == 0u) outward = ox_turn(p->pair, 0u, outward);
    const float3 from = vload3(0, c->position);
    ox_try_way(p, OX_NONE, true, side, c->triangle, &best);
    ox_try_way(p, OX_NONE, true, side, ox_exit_face(p, side, from, outward), &best);
  }
  if (best.triangle != OX_NONE) ox_lead_vertices_out(p, &best);
}

// Of two open surfaces neither has an inside: what does not cross is apart, however near. A vertex
// that lies on the other surface touches it, though. (Sheets have a thickness.)
static void ox_drop_apart(const ox_edge_pair* p) {
  if (((p->mesh[0]->flags | p->mesh[1]->flags) & (OX_MESH_CLOSED | OX_MESH_TWO_SIDED)) != 0u)
    return;
  for (uint i = 0u; i < p->candidate_count; ++i) {
    __global ox_candidate* c = p->candidates + i;
    if ((c->side_kind & OX_HIT_KIND) != OX_HIT_TOUCHING)
      c->side_kind = (c->side_kind & ~OX_HIT_KIND) | OX_HIT_NONE;
  }
}

// item: 1 pair, of a queue.
__kernel void edge_contacts(OX_SCENE_PARAMETERS, __global ox_pair_crossing* crossings,
                            __global uint* order, __global ox_candidate* candidates) {
  const ox_scene scene = OX_SCENE;
  for (uint i = ox_next_item(&scene, OX_QUEUE_EDGE_CONTACTS); i < pair_count;
       i = ox_next_item(&scene, OX_QUEUE_EDGE_CONTACTS)) {
    const uint crossed = found[i].crossings;
    const uint hits = found[i].hits;
    if (crossed == 0u && hits == 0u) continue;
    ox_edge_pair pair;
    pair.pair = pairs + i;
    pair.mesh[0] = meshes + pairs[i].mesh[0];
    pair.mesh[1] = meshes + pairs[i].mesh[1];
    pair.vertices = vertices;
    pair.edges = edges;
    pair.surfaces = scene.surfaces;
    pair.crossings = crossings + found[i].first_crossing;
    pair.order = order + (size_t)OX_ORDERS_PER_CROSSING * found[i].first_crossing;
    pair.by_region = pair.order + crossed;
    pair.region_first = pair.by_region + crossed;
    pair.point_of_region = pair.region_first + crossed;
    pair.next_point = pair.point_of_region + crossed;
    pair.count = crossed;
    pair.regions = 0u;
    pair.candidates = candidates + found[i].first_candidate;
    pair.hits = hits;
    pair.candidate_count = hits;
    pair.most_candidates = hits + OX_POINTS_PER_CROSSING * crossed;
    ox_choose_exits(&pair);
    if (crossed == 0u) {
      ox_drop_apart(&pair);
      ox_drop_beyond_border(&pair);
      for (uint side = 0u; side < 2u; ++side) {
        const ox_hit_count of_side = ox_count_hits(&pair, side);
        if (of_side.fallback != 0u && of_side.inside == 0u)
          ox_lead_mesh_out(&pair, side, of_side.fallback,
                           chunks[pair.mesh[side]->chunk_first].first);
      }
    } else {
      const ox_order by_edge = {pair.order, pair.by_region, crossed, OX_BY_EDGE};
      ox_sort_crossings(&pair, &by_edge);
      ox_find_chords(&pair);
      ox_drop_beyond_border(&pair);
      ox_link_hits(&pair, OX_BY_INNER_VERTEX);
      ox_cover_by_vertices(&pair);
      const ox_order by_facet = {pair.order, pair.by_region, crossed, OX_BY_FACET};
      ox_sort_crossings(&pair, &by_facet);
      ox_tabulate_crossings(&pair, OX_BY_FACETS);
      ox_find_regions(&pair);
      // A sheet has no inside that its edges could be wedges of.
      if (((pair.mesh[0]->flags | pair.mesh[1]->flags) & OX_MESH_TWO_SIDED) == 0u)
        ox_pair_edges(&pair);
      ox_cast_middles(&pair);
      ox_lead_regions_out(&pair);
      ox_lead_deep_out(&pair);
      ox_deepen(&pair);
      ox_reconcile_regions(&pair);
      ox_choose_spokesmen(&pair);
    }
    ox_admit_touching(&pair);
    found[i].hits = pair.candidate_count;
  }
}
#endif
