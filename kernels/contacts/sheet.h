// SPDX-License-Identifier: BSD-3-Clause
// Regions of sheets, which have no inside. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_SHEET_H
#define ODE_EXT_KERNELS_CONTACTS_SHEET_H

#include "contacts/whole_contacts.h"
#include "contacts/whole_region.h"

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

// What is behind a sheet is what its ray meets it for, on whichever side. Each vertex is cleared by
// the face that it is behind. Where there is none, the sheet is moved past a face or an edge of a
// solid. Where that finds nothing either, the edge that goes through the sheet with its shorter end
// the least is drawn back, or through another open mesh with the end that is behind that; where
// there is none of those, the edge of the sheet that goes through the other mesh the least.
static inline void ox_choose_sheet(ox_manifold* m) {
  const ox_region_view* r = m->region;
  bool any = false;
  // Of edges through a sheet, and through a closed mesh.
  uint best[2] = {OX_NONE, OX_NONE};
  ox_plane_choice least[2] = {ox_no_choice(), ox_no_choice()};
  for (uint k = 0u; k < r->count; ++k) {
    __global const ox_feature* f = ox_feature_of(r, k);
    if (f->triangle == OX_NONE) continue;
    const uint side = ox_side_of(f->flags);
    ox_plane_choice choice = ox_no_choice();
    choice.plane = ox_plane_of_face(r->scene, r->pair, 1u - side, f->triangle);
    if (choice.plane.kind == OX_PLANE_NONE) continue;
    if (ox_is_vertex(f->flags)) {
      const float3 position = vload3(0, f->position);
      float depth = ox_plane_depth(&choice.plane, side, position);
      const bool reversed = (f->flags & OX_FEATURE_REVERSED) != 0u;
      if (reversed) {
        depth = -depth;
        choice.plane.normal = -choice.plane.normal;
      }
      if (ox_is_first_item())
        ox_add_candidate(m, &choice, side, position, ox_max(depth, 0.0f),
                         reversed ? OX_HIT_REVERSED : 0u, f->source, f->triangle,
                         ox_touch_of(f, f->triangle));
      ++m->manifold;
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
