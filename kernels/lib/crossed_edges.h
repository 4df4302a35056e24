// SPDX-License-Identifier: BSD-3-Clause
// What the crossings of an edge tell of its ends. Device only.
#ifndef ODE_EXT_KERNELS_LIB_CROSSED_EDGES_H
#define ODE_EXT_KERNELS_LIB_CROSSED_EDGES_H

#include "lib/flood_table.h"

#define OX_END_UNPARTED 0  // the edge does not cross
#define OX_END_INSIDE 1
#define OX_END_OUTSIDE 2

// On which side of the surface that crosses the edge first, seen from it, an end is. Crossings of
// which rounding may have changed the order, at a ridge, in a valley, or where the edge runs along
// a face, are passed over together where as many enter as leave.
static inline uint ox_side_of_end(const ox_scene* scene, const ox_flood_table* table, float near,
                                  uint edge, uint end) {
  const uint word = ox_find_key(scene, table, OX_KEY(edge, OX_KEY_EDGE));
  if (scene->flood_words[word] == 0u) return OX_END_UNPARTED;
  const uint all = scene->flood_words[word + 1u];
  if (scene->crossings[all].of_edge == OX_NONE)  // as mostly
    return (scene->crossings[all].leaves != 0u) == (end == 0u) ? OX_END_INSIDE : OX_END_OUTSIDE;
  const float sign = end == 0u ? 1.0f : -1.0f;
  for (float passed = -INFINITY;;) {
    float first = INFINITY;
    float last = -INFINITY;
    for (uint c = all; c != OX_NONE; c = scene->crossings[c].of_edge) {
      const float begin = sign * scene->crossings[c].t - scene->crossings[c].blur - near;
      if (begin <= passed || begin >= first) continue;
      first = begin;
      last = sign * scene->crossings[c].t + scene->crossings[c].blur + near;
    }
    if (first == INFINITY) return OX_END_UNPARTED;
    for (bool more = true; more;) {
      more = false;
      for (uint c = all; c != OX_NONE; c = scene->crossings[c].of_edge) {
        const float begin = sign * scene->crossings[c].t - scene->crossings[c].blur - near;
        const float until = sign * scene->crossings[c].t + scene->crossings[c].blur + near;
        if (begin < first || begin > last || until <= last) continue;
        last = until;
        more = true;
      }
    }
    int leaving = 0;
    for (uint c = all; c != OX_NONE; c = scene->crossings[c].of_edge) {
      const float begin = sign * scene->crossings[c].t - scene->crossings[c].blur - near;
      if (begin >= first && begin <= last)
        leaving += (scene->crossings[c].leaves != 0u) == (end == 0u) ? 1 : -1;
    }
    if (leaving != 0) return leaving > 0 ? OX_END_INSIDE : OX_END_OUTSIDE;
    passed = last;
  }
}

#endif
