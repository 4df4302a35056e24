// SPDX-License-Identifier: BSD-3-Clause
// The members of a region and its planes: types.h says how they lie. Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_REGION_FIELDS_H
#define ODE_EXT_KERNELS_CONTACTS_REGION_FIELDS_H

#include "contacts/fields.h"
#include "contacts/plane.h"
#include "lib/border.h"

static inline ox_fields ox_members_of(const ox_scene* scene, __global const ox_region* region) {
  const ox_fields list = {scene->members + (ulong)OX_MEMBER_WORDS * region->first, region->count};
  return list;
}

static inline ox_fields ox_planes_of(const ox_scene* scene, __global const ox_region* region) {
  const ox_fields list = {
      scene->planes + (ulong)OX_PLANE_WORDS * OX_PLANES_PER_FEATURE * region->first,
      OX_PLANES_PER_FEATURE * region->count};
  return list;
}

// Whether faces of mesh `side` are planes for a region with these flags. In front of those of an
// open mesh is nothing that is to be moved where the other has no edge and no vertex in it: a
// card that stands in a block cuts the block's face, and is as deep in it as the card's own edges
// are. Nor is in front of those of an open body whose border is in the ground: the ground ends
// beside it.
static inline bool ox_parts_by_faces_of(const ox_scene* scene, uint pair, uint flags, uint side) {
  __global const ox_mesh* mesh = scene->meshes + scene->pairs[pair].mesh[side];
  if ((mesh->flags & OX_MESH_CLOSED) != 0u) return true;
  if (scene->found[pair].at_border[side] != 0u &&
      ox_may_be_behind(mesh, scene->meshes + scene->pairs[pair].mesh[1u - side]))
    return false;
  return (flags & OX_REGION_OF(1u - side)) != 0u;
}

static inline void ox_store_plane(const ox_fields* list, uint i, const ox_plane* plane,
                                  uint flags) {
  ox_set_vector(list, OX_PLANE_NORMAL, i, plane->normal);
  ox_words_of(list, OX_PLANE_FLAGS)[i] = plane->kind | flags;
  ox_floats_of(list, OX_PLANE_OF_BODY)[i] = -INFINITY;  // not asked
  for (uint k = 0u; k < 2u; ++k) {
    ox_floats_of(list, OX_PLANE_LEVEL + k)[i] = plane->level[k];
    ox_words_of(list, OX_PLANE_ID + k)[i] = plane->id[k];
  }
}

static inline ox_plane ox_load_plane(const ox_fields* list, uint i) {
  ox_plane plane;
  plane.index = i;
  plane.normal = ox_vector_of(list, OX_PLANE_NORMAL, i);
  plane.kind = ox_words_of(list, OX_PLANE_FLAGS)[i] & OX_PLANE_KIND;
  for (uint k = 0u; k < 2u; ++k) {
    plane.level[k] = ox_floats_of(list, OX_PLANE_LEVEL + k)[i];
    plane.id[k] = ox_words_of(list, OX_PLANE_ID + k)[i];
  }
  return plane;
}

// A bit for each plane of a block whose flags under a mask are these.
static inline uint ox_of_kind(const ox_fields* list, uint block, uint mask, uint flags) {
  const ox_ints is = (OX_LOAD_WORDS(list, OX_PLANE_FLAGS, block) & (int)mask) == (int)flags;
  return ox_mask_of(&is);
}

#endif
