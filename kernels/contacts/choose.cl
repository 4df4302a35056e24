// SPDX-License-Identifier: BSD-3-Clause
// Choose: by which planes does each region of overlap part, and where are its contacts?
//
// A region is whole where neither mesh has a valley in it, told by an edge or by a face that part
// of the region is past, or where it is all of a part that is inside, but not of two open bodies of
// about one size: then it parts by the least plane that clears all of it. Elsewhere its units,
// vertices and chords, are cleared one by one, the deepest first, then what is far from those, and
// each plane clears what it can.
//
// in    regions, features, faces, edge_planes; pairs, and of meshes all but chunks
// out   candidates for contacts of each pair, and their number
//       planes: which of them part of the region is past, and those of a sheet no more; members:
//       units, in another order
// item  1 region (of a queue); of a work-group, where lanes are one (lib/group.h)
// may overflow: none; a region makes two candidates for each feature at most
#include "contacts/own_faces.h"
#include "contacts/sheet.h"
#include "contacts/unit_order.h"
#include "contacts/valley.h"

// A unit that needs no plane any more.
static void ox_mark_cleared(const ox_region_view* r, uint k) {
  ox_words_of(&r->members, OX_MEMBER_FLAGS)[k] |= OX_MEMBER_CLEARED;
}

// A unit, other than the one that a plane was chosen for and one that is kept, that the last move
// may clear, unless another plane of the same corner has. By one work-item.
static void ox_clear(const ox_manifold* m, const ox_moves* moves, uint k, uint seed, uint kept) {
  const ox_region_view* r = m->region;
  if (k == seed || k == kept || (ox_flags_of(r, k) & OX_MEMBER_CLEARED) != 0u) return;
  const ox_plane_choice by = ox_clearing_plane(r, k, moves);
  if (by.plane.kind == OX_PLANE_NONE) return;
  // A contact of a vertex is on a facet.
  if (by.plane.kind != OX_PLANE_EDGES || !ox_is_vertex(ox_flags_of(r, k)))
    ox_add_cleared(m, &by, ox_feature_of(r, k));
  ox_mark_cleared(r, k);
}

// The member that is the vertex in which a chord ends; OX_NONE: it ends in none.
static uint ox_find_vertex_end(const ox_region_view* r, __global const ox_feature* f) {
  if (ox_is_vertex(f->flags) || f->partner == OX_NONE ||
      !ox_is_vertex(r->scene->features[f->partner].flags))
    return OX_NONE;
  for (uint block = 0u; OX_VECTOR_WIDTH * block < r->count; ++block) {
    const ox_ints is = OX_LOAD_WORDS(&r->members, OX_MEMBER_FEATURE, block) == (int)f->partner;
    const uint found = ox_mask_of(&is) & ox_present_lanes(r->count, block);
    if (found != 0u) return OX_VECTOR_WIDTH * block + ox_lowest(found);
  }
  return OX_NONE;
}

// Moves past the plane that is chosen for a unit, which clears others of those that wait. A chord
// comes out by its middle: the vertex in which it ends may be deeper, and in the other flank of a
// groove still, and waits then, if there is another move. Where it waits no more and is below the
// plane, it has one more contact there. *more: candidates so far beyond one for each feature, for
// which there is room (OX_CANDIDATES_PER_FEATURE).
static void ox_move_past(ox_manifold* m, const ox_plane_choice* choice, uint seed, uint waiting,
                         ox_moves* moves, uint* more) {
  const ox_region_view* r = m->region;
  ox_add_move(r, choice, seed, moves);
  m->manifold = ox_first_past(moves, &choice->plane);
  __global const ox_feature* of_seed = ox_feature_of(r, seed);
  if (choice->plane.kind == OX_PLANE_EDGES)
    ox_add_edge_contact(m, choice);
  else if (ox_is_first_item() && ox_add_cleared(m, choice, of_seed) == 0u)  // all on the rim
    ox_add_feature_contact(m, choice, of_seed);
  uint end = ox_find_vertex_end(r, of_seed);
  const uint side = ox_side_of(of_seed->flags);
  if (end != OX_NONE && (ox_flags_of(r, end) & OX_MEMBER_CLEARED) != 0u) {
    if (choice->plane.kind != OX_PLANE_EDGES && *more < r->count &&
        ox_plane_depth(&choice->plane, side, ox_position_of(r, end)) > 0.0f) {
      ++*more;
      if (ox_is_first_item()) ox_add_feature_contact(m, choice, ox_feature_of(r, end));
    }
  } else if (end != OX_NONE &&
             (moves->count == OX_MOST_PLANES ||
              !ox_stays_inside(r, side, ox_position_of(r, end), &choice->plane, choice->depth))) {
    end = OX_NONE;
  }
  ox_settle();
  for (uint first = 0u; OX_VECTOR_WIDTH * first < waiting; first += OX_BLOCKS_AT_ONCE) {
    uint cleared[OX_BLOCKS_AT_ONCE];
    ox_find_cleared(r, first, waiting, moves, cleared);
    for (uint i = 0u; i < OX_BLOCKS_AT_ONCE; ++i)
      for (uint own = ox_own_bits(cleared[i]); own != 0u; own &= own - 1u)
        ox_clear(m, moves, OX_VECTOR_WIDTH * (first + i) + ox_lowest(own), seed, end);
  }
  ox_settle();
}

// Whether a unit is a chord that does not reach the surface of the solid that it is inside.
static bool ox_is_nested(const ox_region_view* r, uint k) {
  const uint flags = ox_flags_of(r, k);
  return (flags & OX_FEATURE_NESTED) != 0u &&
         (ox_target_of(r, ox_side_of(flags))->flags & OX_MESH_CLOSED) != 0u;
}

// Marks the units that come only where of no other a plane is known, and those that come last. What
// is deepest about a bend, or in a valley, is of the other mesh.
static void ox_mark_later(const ox_region_view* r, uint units) {
  for (uint k = OX_ITEM; k < units; k += OX_ITEMS) {
    const bool is_chord_of_valley = ox_is_of_valley(r, k);
    const bool is_later = ox_is_nested(r, k) || (is_chord_of_valley && ox_is_of_bend(r, k));
    const bool is_last = is_chord_of_valley || ox_is_between_valleys(r, k);
    ox_words_of(&r->members, OX_MEMBER_FLAGS)[k] |=
        (is_later ? OX_MEMBER_LATER : 0u) | (is_last ? OX_MEMBER_VALLEY : 0u);
  }
  ox_settle();
}

// Whether a unit that several planes separate has to pass one of them, and that takes none of the
// moves before it back.
static bool ox_is_needed(const ox_region_view* r, const ox_joint_choice* planes, uint i,
                         const ox_moves* before) {
  const float allowed = OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  return planes->share[i] > 0.0f &&
         ox_taken_back(before, planes->plane[i].normal, planes->depth[i]) <= allowed;
}

// Where a plane is chosen again, what it was chosen for before was not the deepest below it: units
// were deeper below what they propose themselves, as the upper side of a thin part in a thick floor
// is. So it is chosen for the deepest that propose none less, if that goes farther.
static void ox_go_on_to_deepest(const ox_region_view* r, uint waiting, const ox_moves* before,
                                uint* unit, ox_plane_choice* choice, ox_joint_choice* together) {
  bool again = false;
  for (uint i = 0u; i < before->count; ++i)
    again = again || ox_is_same_plane(before->chosen + i, &choice->plane);
  if (!again) return;
  const uint deepest = ox_deepest_below_plane(r, waiting, &choice->plane, OX_MEMBER_VALLEY);
  if (deepest == OX_NONE || deepest == *unit) return;
  ox_joint_choice all;
  const ox_plane_choice other = ox_choose_for(r, deepest, before, &all);
  if (!ox_is_same_plane(&other.plane, &choice->plane) || !(other.depth > choice->depth)) return;
  *unit = deepest;
  *choice = other;
  *together = all;
}

// The unit that comes next, and its planes. What is found for a unit, if it is less deep below that
// than below what it proposed, it proposes; and it waits, if another is deeper then. Few such are
// looked at, and only before the first move, which others follow, since what it goes costs nothing.
static uint ox_choose_next(const ox_region_view* r, uint waiting, const ox_moves* before,
                           ox_plane_choice* choice, ox_joint_choice* together) {
  const uint most = before->count == 0u ? OX_FEW : 0u;
  uint unit = ox_next_unit(r, waiting, before);
  for (uint i = 0u; !ox_is_outside(r, unit); ++i) {
    *choice = ox_choose_for(r, unit, before, together);
    if (i == most || !ox_propose_found(r, unit, choice, together)) break;
    const uint next = ox_next_unit(r, waiting, before);
    if (next == unit) break;
    unit = next;
  }
  return unit;
}

// Moves past the planes that are chosen for the next unit, or for one that is deeper below the
// first of them; returns which. *more: as of ox_move_past.
static uint ox_take_out(ox_manifold* m, uint waiting, ox_moves* moves, uint* more) {
  const ox_region_view* r = m->region;
  ox_joint_choice together;
  ox_plane_choice choice;
  uint unit = ox_choose_next(r, waiting, moves, &choice, &together);
  if (ox_is_outside(r, unit)) {
    if (moves->count != 0u) return unit;  // of a contact where the region has no other
    const ox_plane_choice nearest = ox_choose_nearest(r, unit);
    if (nearest.plane.kind != OX_PLANE_NONE) ox_move_past(m, &nearest, unit, waiting, moves, more);
    return unit;
  }
  if (choice.plane.kind == OX_PLANE_NONE) return unit;
  // What of the other mesh is in the sides of a valley takes those out, and the valley with them.
  if ((ox_flags_of(r, unit) & OX_MEMBER_VALLEY) != 0u &&
      ox_is_taken_out(r, unit, moves, choice.judged))
    return unit;
  ox_go_on_to_deepest(r, waiting, moves, &unit, &choice, &together);
  const uint flags = ox_flags_of(r, unit);
  const uint side = ox_side_of(flags);
  if ((ox_target_of(r, 1u - side)->flags & OX_MESH_DEFORMABLE) != 0u) {
    const ox_plane_choice own = ox_choose_own_face(r, unit, moves, &choice);
    if (ox_is_taken_along(r, unit, moves, ox_min(own.depth, choice.depth))) return unit;
    const uint deepest = ox_deepest_below(r, &own);
    if (deepest < waiting) {
      ox_move_past(m, &own, deepest, waiting, moves, more);
      if (ox_is_first_item()) ox_mark_cleared(r, deepest);
    }
    // Else it has been cleared, or comes later.
    if (deepest < waiting || (deepest != OX_NONE && ox_has_moved(moves, own.plane.normal)))
      return unit;
  }
  ox_move_past(m, &choice, unit, waiting, moves, more);
  const uint ends = ox_is_vertex(flags) ? 1u : 2u;
  for (uint i = 1u; i < together.count && moves->count < OX_MOST_PLANES; ++i) {
    if (!ox_is_needed(r, &together, i, moves)) continue;
    if (*more + ends > r->count) return unit;
    *more += ends;
    choice.plane = together.plane[i];
    choice.depth = together.depth[i];
    ox_move_past(m, &choice, unit, waiting, moves, more);
  }
  return unit;
}

// Clears units, the first of the members, of which ever fewer wait; returns how many moves it took.
static uint ox_clear_units(ox_manifold* m, uint waiting) {
  const ox_region_view* r = m->region;
  ox_moves moves;
  moves.count = 0u;
  uint more = 0u;
  ox_measure_units(r, waiting);
  while (waiting != 0u && moves.count < OX_MOST_PLANES) {
    const uint taken = ox_take_out(m, waiting, &moves, &more);
    ox_settle();
    if (ox_is_first_item()) ox_mark_cleared(r, taken);
    ox_settle();
    waiting = ox_bring_first(r, waiting, OX_MEMBER_CLEARED, 0u);
  }
  return moves.count;
}

static void ox_choose_parts(ox_manifold* m) {
  const ox_region_view* r = m->region;
  const uint units = ox_bring_first(r, r->count, OX_MEMBER_BEGINS, OX_MEMBER_BEGINS);
  ox_mark_later(r, units);
  if (ox_clear_units(m, ox_bring_first(r, units, OX_MEMBER_LATER, 0u)) == 0u)
    ox_clear_units(m, ox_bring_first(r, units, OX_MEMBER_LATER, OX_MEMBER_LATER));
}

// Whether a vertex lies on a face of the other mesh that faces it.
static bool ox_is_against_face(const ox_region_view* r, uint k) {
  __global const ox_feature* f = ox_feature_of(r, k);
  const uint side = ox_side_of(f->flags);
  const float touch = OX_CLEARANCE * r->scene->pairs[r->pair].epsilon;
  const ox_plane face = ox_nearest_face(r, side, ox_position_of(r, k), touch);
  if (face.kind == OX_PLANE_NONE) return false;
  return ox_dot(ox_way_of(side, face.normal), ox_inward_at(r, f)) > 0.0f;
}

// Whether both meshes are open, of about one size, and neither is the ground of the other: what is
// behind them is known no farther than rays reach. Of a bowl in its like all is beside the other's
// wall, and past the planes of its faces it would go by as much as it is high. What falls on
// the floor of an open room is whole: unit by unit cones fell through.
static bool ox_is_of_open_bodies(const ox_region_view* r) {
  __global const ox_mesh* a = ox_target_of(r, 1u);
  __global const ox_mesh* b = ox_target_of(r, 0u);
  return ((a->flags | b->flags) & OX_MESH_CLOSED) == 0u &&
         ox_max(a->radius, b->radius) <= OX_WORTH * ox_min(a->radius, b->radius) &&
         !ox_may_be_behind(a, b) && !ox_may_be_behind(b, a);
}

// Whether a region is separated in units. Where it has no crossings, a part of one mesh is inside
// the other, and leaves as a whole; but not what lies on it all over, as a cavity on what fills it.
static bool ox_is_in_units(const ox_region_view* r) {
  if (ox_is_of_open_bodies(r)) return true;
  if ((r->flags & OX_REGION_VALLEY) == 0u) return false;
  if ((r->flags & OX_REGION_CROSSED) != 0u) return true;
  for (uint k = 0u; k < r->count; ++k)
    if (!ox_is_against_face(r, k)) return false;
  return true;
}

static void ox_choose_planes(const ox_scene* scene) {
  const uint region_count = scene->counters[OX_COUNTER_REGIONS * OX_COUNTER_STRIDE];
  for (uint i = ox_next_item(scene, OX_QUEUE_REGIONS); i < region_count;
       i = ox_next_item(scene, OX_QUEUE_REGIONS)) {
    __global const ox_region* region = scene->regions + i;
    if (region->count == 0u) continue;  // within facets
    ox_region_view view;
    view.scene = scene;
    view.index = i;
    view.pair = region->pair;
    view.count = region->count;
    view.flags = region->flags;
    view.plane_count = region->planes;
    view.members = ox_members_of(scene, region);
    view.faces = scene->faces + OX_FACES_PER_FEATURE * region->first;
    view.planes = ox_planes_of(scene, region);
    ox_manifold manifold;
    manifold.region = &view;
    manifold.candidates = ox_candidates_of(scene, view.pair);
    manifold.count = &scene->found[view.pair].candidates;
    manifold.manifold = 0u;
    const uint mesh_flags = scene->meshes[scene->pairs[view.pair].mesh[0]].flags |
                            scene->meshes[scene->pairs[view.pair].mesh[1]].flags;
    if ((mesh_flags & OX_MESH_TWO_SIDED) != 0u) {
      ox_choose_sheet(&manifold);
    } else if (ox_is_in_units(&view)) {
      ox_choose_parts(&manifold);
    } else {
      const ox_plane_choice choice = ox_choose_whole(&view);
      if (choice.plane.kind == OX_PLANE_NONE)
        ox_choose_parts(&manifold);
      else
        ox_add_whole(&manifold, &choice);
    }
  }
}

__kernel void choose_planes(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_choose_planes(&scene);
}
