// SPDX-License-Identifier: BSD-3-Clause
// Regions of sheets, which have no inside. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_SHEET_H
#define ODE_EXT_KERNELS_CONTACTS_SHEET_H

#include "contacts/feature_table.h"
#include "contacts/whole_contacts.h"
#include "contacts/whole_region.h"
#include "lib/sheet_side.h"

// The plane of a face or an edge of a solid past which a sheet in it is moved; OX_PLANE_NONE: there
// is none, or both are open. A sheet has no front, so its own faces are none.
static inline ox_plane_choice ox_choose_for_sheet(const ox_region_view* r) {
  const uint sheet = (ox_target_of(r, 1u)->flags & OX_MESH_CLOSED) == 0u ? 0u : 1u;
  if ((ox_target_of(r, sheet)->flags & OX_MESH_CLOSED) == 0u) return ox_no_choice();
  const uint of_sheet = sheet == 0u ? OX_PLANE_FACE_OF_A : OX_PLANE_FACE_OF_B;
  for (uint i = OX_ITEM; i < r->plane_count; i += OX_ITEMS) {
    __global uint* flags = ox_words_of(&r->planes, OX_PLANE_FLAGS) + i;
    if ((*flags & OX_PLANE_KIND) == of_sheet) *flags = OX_PLANE_NONE;
  }
  ox_settle();
  ox_region_view by_solid = *r;
  by_solid.flags &= ~OX_REGION_OF(1u - sheet);
  return ox_choose_whole(&by_solid);
}

// [m] how far a vertex is behind a face, or in front of it where that is reversed.
static inline float ox_depth_at_sheet(const ox_region_view* r, const ox_plane* plane, uint side,
                                      uint vertex, bool reversed) {
  const float depth = ox_plane_depth(plane, side, ox_vertex_of(r->scene, r->pair, side, vertex));
  return reversed ? -depth : depth;
}

// Such a vertex.
static inline void ox_add_behind_sheet(ox_manifold* m, const ox_plane_choice* choice, uint side,
                                       uint vertex, bool reversed, __global const ox_feature* f) {
  const ox_region_view* r = m->region;
  const float depth = ox_depth_at_sheet(r, &choice->plane, side, vertex, reversed);
  ox_plane_choice turned = *choice;
  if (reversed) turned.plane.normal = -turned.plane.normal;
  ox_touch touch = ox_touch_of(f, f->triangle);
  touch.feature[side] = OX_OF(OX_OF_VERTEX, vertex);
  if (ox_is_first_item())
    ox_add_candidate(m, &turned, side, ox_vertex_of(r->scene, r->pair, side, vertex),
                     ox_max(depth, 0.0f), reversed ? OX_HIT_REVERSED : 0u, vertex, f->triangle,
                     touch);
  ++m->manifold;
}

// The vertex behind a sheet to which the edge of a crossing leads without another, of a body of
// which it is known where it is; OX_NONE: the edge comes back.
static inline uint ox_find_end_behind(const ox_region_view* r, __global const ox_feature* f,
                                      uint sheet_side) {
  const bool leaves = (f->flags & OX_FEATURE_LEAVES) != 0u;
  const bool is_front = sheet_side == OX_SHEET_FRONT;
  const uint other = is_front ? f->partner : f->next;
  if (other != OX_NONE && !ox_is_vertex(r->scene->features[other].flags)) return OX_NONE;
  return r->scene->edges[f->source].vertex[leaves == is_front ? 0 : 1];
}

// Whether the edge of a crossing has no other.
static inline bool ox_goes_through_once(const ox_region_view* r, __global const ox_feature* f) {
  return f->next == OX_NONE &&
         (f->partner == OX_NONE || ox_is_vertex(r->scene->features[f->partner].flags));
}

// Whether a ray told of a vertex.
static inline bool ox_is_told_by_ray(const ox_region_view* r, uint side, uint vertex) {
  return ox_find_feature(r->scene, ox_inside_key(r->pair, side, vertex)) != OX_NONE;
}

// The first edge at a vertex that goes through the sheet once, and leads to it; OX_NONE: none. Not
// within a facet: that is no member of a region.
static inline uint ox_first_through(const ox_region_view* r, uint side, uint vertex,
                                    uint sheet_side) {
  const ox_scene* scene = r->scene;
  __global const ox_mesh* mesh = ox_mesh_of(scene, scene->pairs + r->pair, side);
  for (uint k = scene->ring_starts[vertex]; k < scene->ring_starts[vertex + 1u]; ++k) {
    const uint edge = scene->rings[k].edge;
    if (ox_is_flat_edge(mesh, edge)) continue;
    const uint entry = ox_find_feature(scene, ox_edge_key(r->pair, side, edge));
    if (entry == OX_NONE) continue;
    __global const ox_feature* f = scene->features + (entry >> 2);
    if (ox_goes_through_once(r, f) && ox_find_end_behind(r, f, sheet_side) == vertex) return edge;
  }
  return OX_NONE;
}

// From a vertex to where no edge leads deeper that does not go through the sheet.
static inline uint ox_walk_deeper(const ox_region_view* r, const ox_plane* plane, uint side,
                                  uint vertex, bool reversed) {
  const ox_scene* scene = r->scene;
  float depth = ox_depth_at_sheet(r, plane, side, vertex, reversed);
  for (uint from = OX_NONE; from != vertex;) {
    from = vertex;
    for (uint k = scene->ring_starts[from]; k < scene->ring_starts[from + 1u]; ++k) {
      const uint other = scene->rings[k].vertex;
      const float there = ox_depth_at_sheet(r, plane, side, other, reversed);
      if (!(there > depth)) continue;
      const ox_feature_key key = ox_edge_key(r->pair, side, scene->rings[k].edge);
      if (ox_find_feature(scene, key) != OX_NONE) continue;
      depth = there;
      vertex = other;
    }
  }
  return vertex;
}

// Where it is known on which side of a sheet a body is, what its edges lead to on the other has
// gone through, though its rays, which are as long as the body is thick, may not tell: of an open
// body each end of such an edge, and of any the deepest vertex beyond. False: none is so.
static inline bool ox_add_ends_behind(ox_manifold* m, uint sheet, uint sheet_side) {
  const ox_region_view* r = m->region;
  const ox_scene* scene = r->scene;
  const uint side = 1u - sheet;
  const bool reversed = sheet_side == OX_SHEET_BACK;
  const bool is_open =
      (ox_mesh_of(scene, scene->pairs + r->pair, side)->flags & OX_MESH_CLOSED) == 0u;
  bool any = false;
  uint deepest = OX_NONE;  // of these ends, by a crossing
  __global const ox_feature* by = 0;
  float most = -INFINITY;  // [m]
  ox_plane_choice choice = ox_no_choice();
  for (uint k = 0u; k < r->count; ++k) {
    __global const ox_feature* f = ox_feature_of(r, k);
    if (ox_is_vertex(f->flags) || ox_side_of(f->flags) != side) continue;
    const uint vertex = ox_find_end_behind(r, f, sheet_side);
    if (vertex == OX_NONE) continue;
    choice.plane = ox_plane_of_face(scene, r->pair, sheet, f->triangle);
    if (choice.plane.kind == OX_PLANE_NONE) continue;
    const float depth = ox_depth_at_sheet(r, &choice.plane, side, vertex, reversed);
    // Members come in any order.
    const bool is_first =
        vertex != deepest
            ? vertex < deepest
            : f->source < by->source || (f->source == by->source && f->triangle < by->triangle);
    if (depth > most || (depth == most && is_first)) {
      deepest = vertex;
      by = f;
      most = depth;
    }
    if (!is_open || ox_is_told_by_ray(r, side, vertex)) continue;
    const uint first = ox_first_through(r, side, vertex, sheet_side);
    if (first != OX_NONE && first != f->source) continue;
    ox_add_behind_sheet(m, &choice, side, vertex, reversed, f);
    any = true;
  }
  if (deepest == OX_NONE) return any;
  choice.plane = ox_plane_of_face(scene, r->pair, sheet, by->triangle);
  const uint vertex = ox_walk_deeper(r, &choice.plane, side, deepest, reversed);
  const bool is_end = vertex == deepest || ox_first_through(r, side, vertex, sheet_side) != OX_NONE;
  if (ox_is_told_by_ray(r, side, vertex) || (is_open && is_end)) return any;
  ox_add_behind_sheet(m, &choice, side, vertex, reversed, by);
  return true;
}

// What is behind a sheet is what its ray meets it for, on whichever side, or on the one on which
// the body is not (lib/sheet_side.h). Each vertex is cleared by the face that it is behind. Where
// there is none, the sheet is moved past a face or an edge of a solid. Where that finds nothing
// either, the edge that goes through the sheet with its shorter end the least is drawn back, or
// through another open mesh with the end that is behind that; where there is none of those, the
// edge of the sheet that goes through the other mesh the least.
static inline void ox_choose_sheet(ox_manifold* m) {
  const ox_region_view* r = m->region;
  const ox_scene* scene = r->scene;
  const uint sheet = ox_sheet_of(scene, scene->pairs + r->pair);
  const uint sheet_side = scene->found[r->pair].sheet_side;
  const bool is_told = sheet_side != OX_SHEET_UNTOLD;
  bool any = is_told && ox_add_ends_behind(m, sheet, sheet_side);
  // Of edges through a sheet, and through a closed mesh.
  uint best[2] = {OX_NONE, OX_NONE};
  ox_plane_choice least[2] = {ox_no_choice(), ox_no_choice()};
  for (uint k = 0u; k < r->count; ++k) {
    __global const ox_feature* f = ox_feature_of(r, k);
    if (f->triangle == OX_NONE) continue;
    const uint side = ox_side_of(f->flags);
    // An open body whose border is in the sheet ends there; the sheet goes on beside it.
    if (is_told && side == sheet && (r->flags & OX_REGION_OF(1u - sheet)) != 0u &&
        scene->found[r->pair].at_border[1u - sheet] != 0u)
      continue;
    ox_plane_choice choice = ox_no_choice();
    choice.plane = ox_plane_of_face(r->scene, r->pair, 1u - side, f->triangle);
    if (choice.plane.kind == OX_PLANE_NONE) continue;
    if (ox_is_vertex(f->flags)) {
      ox_add_behind_sheet(m, &choice, side, f->source, (f->flags & OX_FEATURE_REVERSED) != 0u, f);
      any = true;
      continue;
    }
    __global const ox_mesh* target = r->scene->meshes + r->scene->pairs[r->pair].mesh[1u - side];
    const bool is_solid = (target->flags & OX_MESH_CLOSED) != 0u;
    if (is_solid) {  // as deep as the other end of the chord
      const float3 end = ox_vector_of(&r->members, OX_MEMBER_END, k);
      choice.depth = ox_max(ox_plane_depth(&choice.plane, side, end), 0.0f);
    } else {
      __global const ox_edge* edge = r->scene->edges + f->source;
      const float3 from = ox_vertex_of(r->scene, r->pair, side, edge->vertex[0]);
      const float3 to = ox_vertex_of(r->scene, r->pair, side, edge->vertex[1]);
      const float3 d = to - from;
      const float of_from = ox_plane_depth(&choice.plane, side, from);
      const float of_to = ox_plane_depth(&choice.plane, side, to);
      // A sheet has no front; of the ends of an edge through another open mesh one is behind it.
      float depth = ox_max(ox_max(of_from, of_to), 0.0f);
      if ((target->flags & OX_MESH_TWO_SIDED) != 0u)
        depth = f->t * f->t < 0.25f * ox_dot(d, d) ? of_from : of_to;
      if (depth < 0.0f) choice.plane.normal = -choice.plane.normal;
      choice.depth = ox_min(fabs(depth), target->reach);
    }
    choice.plane.id[1] = f->source;  // of one face the first edge
    choice.judged = choice.depth;
    if (!ox_is_better_choice(&choice, least + is_solid)) continue;
    least[is_solid] = choice;
    best[is_solid] = k;
  }
  if (any) return;
  const ox_plane_choice choice = ox_choose_for_sheet(r);
  if (choice.plane.kind != OX_PLANE_NONE) {
    ox_add_whole(m, &choice);
    return;
  }
  const uint through = best[0] != OX_NONE ? 0u : 1u;
  if (best[through] == OX_NONE || !ox_is_first_item()) return;
  __global const ox_feature* f = ox_feature_of(r, best[through]);
  ox_add_candidate(m, least + through, ox_side_of(f->flags), vload3(0, f->position),
                   least[through].depth, OX_HIT_POINT, f->at[0], f->triangle,
                   ox_touch_of(f, f->triangle));
}

#endif
