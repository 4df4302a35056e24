// SPDX-License-Identifier: BSD-3-Clause
// The plane that a unit is separated by. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_UNIT_PLANE_H
#define ODE_EXT_KERNELS_CONTACTS_UNIT_PLANE_H

#include "contacts/joint_way.h"
#include "contacts/unit_moves.h"

// A unit that a plane is looked for.
typedef struct {
  uint unit;
  uint side;
  uint through[2];  // crossings by which it goes through the other mesh
  uint count;       // of those
  float3 inward;    // into its own mesh
  const ox_moves* before;
  ox_refused refused;
} ox_seed;

// The way into its own mesh at a feature; of an edge of any length.
static inline float3 ox_inward_of(const ox_region_view* r, __global const ox_feature* f) {
  if (ox_is_vertex(f->flags)) return ox_inward_at(r, f);
  const uint side = ox_side_of(f->flags);
  float3 inward = (float3)(0.0f);
  for (uint k = 0u; k < 2u; ++k)
    if (f->at[k] != OX_NONE) inward -= ox_normal_of(r->scene, r->pair, side, f->at[k]);
  return inward;
}

// How deep what of its mesh is in the region is below a plane that a unit is next to, where its
// mesh goes on behind that, as where sides of both are flush; else 0. Infinite beyond `limit`: not
// all members are gone through then, in whatever order they lie.
static inline float ox_depth_behind(const ox_region_view* r, const ox_seed* seed,
                                    const ox_plane* plane, float depth, float limit) {
  const float3 direction = ox_way_of(seed->side, plane->normal);
  if (ox_is_on_open(r) || !ox_looks_back(seed->inward, direction)) return 0.0f;
  const float next = depth / OX_MERGE;
  // Nothing of its mesh is farther from the unit than the mesh is wide.
  const float farthest = depth + 2.0f * ox_target_of(r, 1u - seed->side)->radius;
  if (farthest + OX_CLEARANCE * r->scene->pairs[r->pair].epsilon < next) return 0.0f;
  const float enough = ox_max(next, limit);
  float behind = 0.0f;
  for (uint block = 0u; OX_VECTOR_WIDTH * block < r->count; ++block) {
    float least, most;
    ox_extent_of_block(r, block, seed->side, -direction, &least, &most);
    behind = ox_max(behind, plane->level[seed->side] + most);
    if (behind > enough) return INFINITY;
  }
  return behind > next ? behind : 0.0f;
}

static inline ox_seed ox_seed_of(const ox_region_view* r, uint unit, const ox_moves* before) {
  ox_seed seed;
  seed.before = before;
  seed.unit = unit;
  seed.side = ox_side_of(ox_flags_of(r, unit));
  seed.count = 0u;
  seed.refused.count = 0u;
  seed.inward = ox_inward_of(r, ox_feature_of(r, unit));
  uint feature = ox_words_of(&r->members, OX_MEMBER_FEATURE)[unit];
  while (feature != OX_NONE && seed.count < 2u) {
    __global const ox_feature* f = r->scene->features + feature;
    if (ox_is_vertex(f->flags)) break;
    seed.through[seed.count++] = feature;
    feature = f->partner;
  }
  return seed;
}

// Whether the curve in which the surfaces meet runs over the facet of a plane; two edges cross.
// A region has one plane of a facet; that of another triangle of it may be asked for too.
static inline bool ox_is_crossed(const ox_region_view* r, const ox_plane* plane) {
  if (plane->kind == OX_PLANE_EDGES) return true;
  if (plane->index != OX_NONE)
    return (ox_words_of(&r->planes, OX_PLANE_FLAGS)[plane->index] & OX_PLANE_CROSSED) != 0u;
  const uint facet = ox_facet_of(r->scene, plane->id[0]);
  for (uint block = 0u; OX_VECTOR_WIDTH * block < r->plane_count; ++block) {
    uint crossed = ox_of_kind(&r->planes, block, OX_PLANE_KIND | OX_PLANE_CROSSED,
                              plane->kind | OX_PLANE_CROSSED) &
                   ox_present_lanes(r->plane_count, block);
    for (; crossed != 0u; crossed &= crossed - 1u) {
      const uint other = OX_VECTOR_WIDTH * block + ox_lowest(crossed);
      if (ox_facet_of(r->scene, ox_words_of(&r->planes, OX_PLANE_ID)[other]) == facet) return true;
    }
  }
  return false;
}

// Takes a plane for a unit if it is better.
static inline void ox_try_unit(const ox_region_view* r, const ox_seed* seed, const ox_plane* plane,
                               ox_plane_choice* best) {
  if (ox_is_refused(&seed->refused, plane, OX_WAY_OF_UNIT)) return;
  ox_plane_choice choice = ox_no_choice();
  choice.plane = *plane;
  choice.depth = ox_unit_depth(r, seed->unit, plane);
  if (choice.depth == INFINITY) return;
  choice.judged = ox_cost_of(r, seed->before, plane, choice.depth);
  if (!ox_is_better_choice(&choice, best)) return;
  // All of that has to pass.
  const float limit = best->judged + ox_gone_along(seed->before, plane->normal);
  const float behind = ox_depth_behind(r, seed, plane, choice.depth, limit);
  choice.judged = ox_max(choice.judged, ox_cost_of(r, seed->before, plane, behind));
  if (!ox_is_better_choice(&choice, best)) return;
  // Where it goes on through a face that looks back, all of the body has to pass the plane, as of
  // a whole region. A chord tells that by its crossings, a vertex by those of the region: what is
  // in a board by more than half of it is not to leave by the side that nothing of it has met.
  const float3 direction = ox_way_of(seed->side, plane->normal);
  for (uint i = 0u; i < seed->count; ++i) {
    __global const ox_feature* f = r->scene->features + seed->through[i];
    const float3 back = ox_normal_of(r->scene, r->pair, 1u - seed->side, f->triangle);
    if (!ox_looks_back(back, direction)) continue;
    float of_body = ox_depth_of_body(r, plane, seed->side, limit);
    if (ox_is_doubted(of_body, choice.depth, limit) &&
        !ox_edge_comes_back(r, seed->side, f, back, plane, choice.depth,
                            ox_way_of(seed->side, ox_gone_aside(seed->before, plane->normal))))
      of_body = ox_doubted(choice.depth);
    choice.judged = ox_max(choice.judged, ox_cost_of(r, seed->before, plane, of_body));
  }
  if (!ox_is_better_choice(&choice, best)) return;
  if (seed->count == 0u && !ox_is_crossed(r, plane) && ox_crosses_back(r, plane, seed->side)) {
    const float of_body = ox_depth_of_body(r, plane, seed->side, limit);
    choice.judged = ox_max(choice.judged, ox_cost_of(r, seed->before, plane, of_body));
  }
  if (ox_is_better_choice(&choice, best)) *best = choice;
}

// The ends of a unit, by which its planes are looked for in many blocks.
typedef struct {
  float3 one, other;
  uint side;
  float past;  // [m] the least that a plane clears it by, of both ends
} ox_ends;

static inline ox_ends ox_ends_of(const ox_region_view* r, uint unit) {
  const float past = -OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  const ox_ends ends = {ox_position_of(r, unit), ox_vector_of(&r->members, OX_MEMBER_END, unit),
                        ox_side_of(ox_flags_of(r, unit)), past + past};
  return ends;
}

// A bit for each plane of a block that clears a unit by a move of `limit` at most, beyond what the
// moves before go along it.
static inline uint ox_clearing_planes(const ox_region_view* r, uint block, const ox_moves* before,
                                      const ox_ends* ends, float limit) {
  ox_floats one, other;
  ox_dot_fields(&r->planes, OX_PLANE_NORMAL, block, ends->one, &one);
  ox_dot_fields(&r->planes, OX_PLANE_NORMAL, block, ends->other, &other);
  const ox_floats level = OX_LOAD_FLOATS(&r->planes, OX_PLANE_LEVEL + ends->side, block);
  one = ends->side == 0u ? level - one : level + one;
  other = ends->side == 0u ? level - other : level + other;
  ox_floats gone = (ox_floats)(0.0f);
  for (uint i = 0u; i < before->count; ++i) {
    ox_floats along;
    ox_dot_fields(&r->planes, OX_PLANE_NORMAL, block, before->chosen[i].normal, &along);
    along *= before->lent[i];
    gone = OX_GREATER(gone, along);
  }
  // Those of other kinds clear the other mesh alone.
  const int others = (int)(ends->side == 0u ? OX_PLANE_FACE_OF_A : OX_PLANE_FACE_OF_B);
  const ox_ints clears =
      (one + other >= ends->past) & (one - gone <= limit) & (other - gone <= limit) &
      ((OX_LOAD_WORDS(&r->planes, OX_PLANE_FLAGS, block) & (int)OX_PLANE_KIND) != others);
  return ox_mask_of(&clears) & ox_present_lanes(r->plane_count, block);
}

// The edge at which two facets meet that triangles are of, if it is a side of either; or OX_NONE.
static inline uint ox_edge_between(const ox_scene* scene, uint one, uint other) {
  if (ox_facet_of(scene, one) == ox_facet_of(scene, other)) return OX_NONE;
  for (uint turn = 0u; turn < 2u; ++turn) {
    const uint facet = ox_facet_of(scene, turn == 0u ? other : one);
    __global const ox_triangle* t = scene->surfaces.triangles + (turn == 0u ? one : other);
    for (uint k = 0u; k < 3u; ++k) {
      const uint at = ox_side_of_triangle(t, k);
      if (!ox_is_edge(at)) continue;
      for (uint i = 0u; i < 2u; ++i) {
        const uint face = scene->edges[at].triangle[i];
        if (face != OX_NONE && ox_facet_of(scene, face) == facet) return at;
      }
    }
  }
  return OX_NONE;
}

// The pair of the edge of a chord and of that between the two facets that it goes through, as of a
// wedge whose own edge goes on below what the chord is the rim of. OX_PLANE_NONE: there is none.
static inline ox_plane ox_plane_across(const ox_region_view* r, const ox_seed* seed) {
  if (seed->count != 2u) return ox_no_plane();
  __global const ox_feature* one = r->scene->features + seed->through[0];
  const uint edge =
      ox_edge_between(r->scene, one->triangle, r->scene->features[seed->through[1]].triangle);
  if (edge == OX_NONE) return ox_no_plane();
  return seed->side == 0u ? ox_plane_of_edges(r->scene, r->pair, one->source, edge)
                          : ox_plane_of_edges(r->scene, r->pair, edge, one->source);
}

// Of all planes of the region, and a unit's own, the best for it. Its own is tried first: what
// costs more need not be looked at. But last where all of its body may have to pass it: how far
// that is need not be known beyond what others cost.
static inline ox_plane_choice ox_search_for(const ox_region_view* r, const ox_seed* seed) {
  ox_plane_choice best = ox_no_choice();
  const ox_plane own = ox_own_plane(r, seed->unit);
  const bool is_last = seed->count == 0u && own.index != OX_NONE && !ox_is_crossed(r, &own);
  if (!is_last) ox_try_unit(r, seed, &own, &best);
  // Where that costs more than it is worth.
  if (best.judged > OX_WORTH * ox_floats_of(&r->members, OX_MEMBER_LEAST)[seed->unit]) {
    const ox_plane across = ox_plane_across(r, seed);
    ox_try_unit(r, seed, &across, &best);
  }
  for (uint i = 0u; i < seed->before->count; ++i) {
    const ox_plane on = ox_plane_on(r, seed->before, i);
    ox_try_unit(r, seed, &on, &best);
  }
  const ox_ends ends = ox_ends_of(r, seed->unit);
  const uint blocks = (r->plane_count + OX_VECTOR_WIDTH - 1u) / OX_VECTOR_WIDTH;
  for (uint first = 0u; first < blocks; first += OX_BLOCKS_AT_ONCE) {
    uint clears[OX_BLOCKS_AT_ONCE];
    for (uint i = 0u; i < OX_BLOCKS_AT_ONCE; ++i)
      clears[i] =
          ox_clearing_planes(r, min(first + i, blocks - 1u), seed->before, &ends, best.judged);
    for (uint i = 0u; i < OX_BLOCKS_AT_ONCE && first + i < blocks; ++i)
      for (; clears[i] != 0u; clears[i] &= clears[i] - 1u) {
        const uint k = OX_VECTOR_WIDTH * (first + i) + ox_lowest(clears[i]);
        const ox_plane plane = ox_load_plane(&r->planes, k);
        ox_try_unit(r, seed, &plane, &best);
      }
  }
  if (is_last) ox_try_unit(r, seed, &own, &best);
  return best;
}

static inline bool ox_unit_stays(const ox_region_view* r, const ox_seed* seed,
                                 const ox_plane_choice* choice) {
  return ox_stays_inside(r, seed->side, ox_middle_of(r, seed->unit), &choice->plane, choice->depth);
}

// The nearest of the faces of the other mesh that a point is behind, where it leaves the mesh by
// that; else OX_PLANE_NONE, as of a wall that goes on inside the floor it stands on.
static inline ox_plane ox_surface_near(const ox_region_view* r, uint side, float3 p, float bound) {
  const ox_plane nearest = ox_nearest_behind(r, side, p, bound);
  if (nearest.kind == OX_PLANE_NONE ||
      !ox_stays_inside(r, side, p, &nearest, ox_plane_depth(&nearest, side, p)))
    return nearest;
  return ox_no_plane();
}

// The least of the planes that do not separate it, where all together do; else OX_PLANE_NONE. Where
// it is still inside past all, the nearest face that it is behind there is one more: of a corner
// the region need not meet all. A plane that separates it alone is better up to twice the price of
// all: it clears more. *together: all of them.
static inline ox_plane_choice ox_leave_jointly(const ox_region_view* r, const ox_seed* seed,
                                               const ox_joint_choice* planes,
                                               const ox_plane_choice* known,
                                               ox_joint_choice* together) {
  ox_joint_choice joint = *planes;  // and of those that it lands in
  const float3 one = ox_position_of(r, seed->unit);
  const float3 other = ox_vector_of(&r->members, OX_MEMBER_END, seed->unit);
  for (;;) {
    const float longer = ox_lengthened(r, &joint);
    float sum = 0.0f;
    for (uint i = 0u; i < joint.count; ++i) sum += joint.share[i];
    ox_plane_choice choice = joint.first;
    choice.judged = OX_WORTH * (choice.judged - joint.far[0] + longer * sum);
    if (!ox_is_better_choice(&choice, known)) return ox_no_choice();
    const float3 way = ox_way_of(seed->side, longer * joint.way);
    const float3 p = 0.5f * (one + other) + way;
    // Past one plane alone it is known to be inside.
    if (joint.count > 1u && !ox_is_still_inside(r, seed->side, p, way)) {
      *together = joint;
      // A way that is much longer than to the surface is not that of a corner.
      const float nearer = sqrt(ox_dot(way, way)) / OX_WORTH;
      if (ox_surface_near(r, seed->side, p - way, nearer).kind != OX_PLANE_NONE)
        together->count = 0u;
      return choice;
    }
    if (planes->count != 1u || joint.count == OX_FEW) return ox_no_choice();
    // What it is on to within rounding may keep it inside as well.
    const ox_plane next =
        ox_nearest_of(r, seed->side, p, known->judged, r->scene->pairs[r->pair].epsilon);
    if (next.kind == OX_PLANE_NONE) return ox_no_choice();
    const float depth =
        ox_max(ox_plane_depth(&next, seed->side, one), ox_plane_depth(&next, seed->side, other));
    ox_add_to_joint(r, &next, depth, &joint);
  }
}

// How far its own mesh goes on from a unit along a direction [m], to its next wall, by a ray from
// as far inside it as rounding may take it out. An open mesh has no inside, and is taken to go on.
static inline float ox_own_way(const ox_region_view* r, const ox_seed* seed, float3 direction) {
  if ((ox_target_of(r, 1u - seed->side)->flags & OX_MESH_CLOSED) == 0u) return INFINITY;
  const float length = sqrt(ox_dot(seed->inward, seed->inward));
  const float inside = OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  float3 p = ox_middle_of(r, seed->unit);
  if (length > 0.0f) p += inside / length * seed->inward;
  const ox_nearest met = ox_cast_into(r, 1u - seed->side, p, direction);
  return met.back_t < met.front_t ? met.back_t : 0.0f;
}

// Whether a unit may have come in by a plane: a chord that crosses its facet, of which two edges
// have none. A vertex has no crossings to tell.
static inline bool ox_may_come_by(const ox_region_view* r, const ox_seed* seed,
                                  const ox_plane* plane) {
  if (seed->count == 0u) return true;
  if (plane->kind == OX_PLANE_EDGES) return false;
  const uint facet = ox_facet_of(r->scene, plane->id[0]);
  for (uint i = 0u; i < seed->count; ++i)
    if (ox_facet_of(r->scene, r->scene->features[seed->through[i]].triangle) == facet) return true;
  return false;
}

// The best plane for a unit. Where one does not separate it, that and those that do not either may
// do so together: then all of them are its. Else the way along its normal is past all of both
// bodies. Of a surface that bends inwards there are many that cost less than what the unit proposes
// itself and do not separate it; so that is asked after few of them, and taken if it takes no more
// of the moves before it back. Nothing has to go much farther than to the surface: where what is
// found does, it is to pass the nearest face, and what is beside it says the rest; but not on
// through a thin part that what is beside it comes back from. *together: where it takes several
// planes these, of which the least is returned; else none.
static inline ox_plane_choice ox_choose_for(const ox_region_view* r, uint unit,
                                            const ox_moves* before, ox_joint_choice* together) {
  ox_seed seed = ox_seed_of(r, unit, before);
  ox_plane_choice known = ox_no_choice();  // the best so far
  ox_joint_choice joint = ox_begin_joint();
  *together = joint;
  while (seed.refused.count < OX_FEW) {
    ox_plane_choice choice = ox_search_for(r, &seed);
    if (choice.plane.kind == OX_PLANE_NONE || !ox_is_better_choice(&choice, &known)) break;
    const bool separates = !ox_unit_stays(r, &seed, &choice);
    if (!separates) {
      ox_refuse(&seed.refused, &choice.plane);
      if (joint.count == 0u) joint.first = choice;
      ox_add_to_joint(r, &choice.plane, choice.depth, &joint);
      const float of_both = ox_max(choice.depth, ox_depth_of_both(r, choice.plane.normal));
      choice.judged = ox_cost_of(r, before, &choice.plane, of_both);
    }
    if (ox_is_better_choice(&choice, &known)) {
      known = choice;
      together->count = 0u;
    }
    if (separates) break;
    ox_joint_choice all;
    choice = ox_leave_jointly(r, &seed, &joint, &known, &all);
    if (!ox_is_better_choice(&choice, &known)) continue;
    known = choice;
    *together = all;
  }
  if (seed.refused.count == OX_FEW) {
    ox_plane_choice own = known;
    const ox_plane plane = ox_own_plane(r, unit);
    ox_try_unit(r, &seed, &plane, &own);
    const float allowed = ox_taken_back(before, known.plane.normal, known.depth) +
                          OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
    if (ox_is_better_choice(&own, &known) &&
        ox_taken_back(before, own.plane.normal, own.depth) <= allowed &&
        !ox_unit_stays(r, &seed, &own)) {
      known = own;
      together->count = 0u;
    }
  }
  if (together->count != 0u) return known;
  // What the moves before have taken out goes no other way.
  if (known.judged <= OX_MARGIN * r->scene->pairs[r->pair].epsilon) return known;
  const float far = ox_min(known.depth, known.judged) / OX_WORTH;
  const ox_plane nearest = ox_nearest_behind(r, seed.side, ox_middle_of(r, unit), far);
  ox_plane_choice near = ox_no_choice();
  if (!ox_take_better(r, unit, &nearest, far, &near) ||
      (ox_depth_behind(r, &seed, &nearest, near.depth, far) > far &&
       ox_own_way(r, &seed, -ox_way_of(seed.side, nearest.normal)) > far))
    return known;
  // What of a body is more than halfway through a thin part goes back by the face that it came in
  // by, as what is beside it does, which is not so deep: it has met that, and not the other side.
  // Of a thread it has met both, and it came in from where its own body goes on.
  const bool is_past_middle =
      ox_looks_back(nearest.normal, known.plane.normal) && ox_is_crossed(r, &known.plane) &&
      !ox_unit_stays(r, &seed, &known) &&
      ((!ox_is_crossed(r, &nearest) && ox_may_come_by(r, &seed, &known.plane)) ||
       ox_own_way(r, &seed, ox_way_of(seed.side, known.plane.normal)) > far);
  if (is_past_middle) return known;
  if (!ox_unit_stays(r, &seed, &near)) return near;
  // Where that takes it into another face, past that too.
  joint = ox_begin_joint();
  joint.first = near;
  ox_add_to_joint(r, &near.plane, near.depth, &joint);
  near = ox_leave_jointly(r, &seed, &joint, &known, together);
  return near.plane.kind == OX_PLANE_NONE ? known : near;
}

// Has a unit propose the face that was found for it, once, where that costs less than what it
// proposed; returns whether it does.
static inline bool ox_propose_found(const ox_region_view* r, uint unit,
                                    const ox_plane_choice* choice,
                                    const ox_joint_choice* together) {
  const uint flags = ox_flags_of(r, unit);
  const float proposed = ox_floats_of(&r->members, OX_MEMBER_LEAST)[unit];
  ox_plane_choice own = *choice;
  own.depth = ox_max(own.depth, own.judged);
  if ((flags & OX_MEMBER_FOUND) != 0u || together->count != 0u || own.plane.kind == OX_PLANE_NONE ||
      own.plane.kind == OX_PLANE_EDGES ||
      !(own.depth < proposed - OX_CLEARANCE * r->scene->pairs[r->pair].epsilon))
    return false;
  ox_settle();
  ox_words_of(&r->members, OX_MEMBER_FLAGS)[unit] = flags | OX_MEMBER_FOUND;
  ox_propose_face(r, unit, &own);
  return true;
}

#endif
