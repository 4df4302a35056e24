// SPDX-License-Identifier: BSD-3-Clause
// Chords of valleys: of edges at which their mesh bends inwards, and goes on at both sides. Device
// only.
#ifndef ODE_EXT_KERNELS_CONTACTS_VALLEY_H
#define ODE_EXT_KERNELS_CONTACTS_VALLEY_H

#include "contacts/units.h"

static inline bool ox_is_of_valley(const ox_region_view* r, uint k) {
  return !ox_is_vertex(ox_flags_of(r, k)) &&
         ox_is_valley(r->scene, r->pair, ox_feature_of(r, k)->source);
}

// Whether a unit is a chord of an edge at which its mesh bends inwards a little, so that the faces
// there face one way. It comes out past no face of the other mesh that does not: its own mesh goes
// on beside it, as a floor does on both sides of where it begins to rise.
static inline bool ox_is_of_bend(const ox_region_view* r, uint k) {
  if (!ox_is_of_valley(r, k)) return false;
  __global const ox_feature* f = ox_feature_of(r, k);
  const uint side = ox_side_of(f->flags);
  return ox_dot(ox_normal_of(r->scene, r->pair, side, f->at[0]),
                ox_normal_of(r->scene, r->pair, side, f->at[1])) > OX_SAME_WAY;
}

#endif
