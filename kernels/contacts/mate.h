// SPDX-License-Identifier: BSD-3-Clause
// The mate of a crossing: the other end of a stretch of the curve. Device only.
//
// Two facets have stretches of the line in common where their planes meet. Both ends of a stretch
// have the pair of facets in common, and mostly they are the only ones that have. Where facets are
// not convex there may be several, which lie one behind the other on the line.
#ifndef ODE_EXT_KERNELS_CONTACTS_MATE_H
#define ODE_EXT_KERNELS_CONTACTS_MATE_H

#include "contacts/feature_table.h"

// How far along a line; of those at one place the first comes first.
typedef struct {
  uint entry;  // feature << 1 | which of the facets at its edge; OX_NONE: there is none
  float place;
} ox_on_line;

static inline bool ox_is_before_on_line(__global const ox_feature* features, const ox_on_line* a,
                                        const ox_on_line* b) {
  return a->place != b->place
             ? a->place < b->place
             : ox_is_before(features + (a->entry >> 1), features + (b->entry >> 1));
}

// Along the line in which the planes of two facets meet: that crossed, and one at the edge.
static inline float3 ox_line_at(const ox_scene* scene, __global const ox_feature* f, uint which) {
  const uint side = ox_side_of(f->flags);
  const float3 of_edge = ox_normal_of(scene, f->pair, side, f->at[which]);
  const float3 crossed = ox_normal_of(scene, f->pair, 1u - side, f->triangle);
  return side == 0u ? ox_plain_cross(of_edge, crossed) : ox_plain_cross(crossed, of_edge);
}

// Of the ends of stretches that two facets have in common the last before a place and the first
// after it.
typedef struct {
  ox_on_line last, next;
  uint before;  // how many are
  bool are_many;
} ox_neighbours_on_line;

// Of those from an entry on to where it ends, at `end`, as the ring of mates goes.
static inline ox_neighbours_on_line ox_find_on_line(const ox_scene* scene, uint entry, uint end,
                                                    float3 line, const ox_on_line* self) {
  ox_neighbours_on_line found = {{OX_NONE, 0.0f}, {OX_NONE, 0.0f}, 0u, false};
  uint count = 0u;
  uint n = entry;
  do {
    found.are_many = ++count == OX_MANY;  // each looks at all
    const ox_on_line other = {n, ox_dot(line, vload3(0, scene->features[n >> 1].position))};
    if (ox_is_before_on_line(scene->features, &other, self)) {
      ++found.before;
      if (found.last.entry == OX_NONE || ox_is_before_on_line(scene->features, &found.last, &other))
        found.last = other;
    } else if (found.next.entry == OX_NONE ||
               ox_is_before_on_line(scene->features, &other, &found.next)) {
      found.next = other;
    }
    n = scene->features[n >> 1].mate[n & 1u];
  } while (n != end && !found.are_many);
  return found;
}

// The other end of a stretch, of either mesh; OX_NONE: it is not known.
static inline uint ox_find_other_end(const ox_scene* scene, uint entry) {
  __global const ox_feature* f = scene->features + (entry >> 1);
  const uint second = f->mate[entry & 1u];
  if (second == OX_NONE || second == entry) return OX_NONE;
  if (scene->features[second >> 1].mate[second & 1u] == entry) return second;
  const float3 line = ox_line_at(scene, f, entry & 1u);
  const ox_on_line self = {entry, ox_dot(line, vload3(0, f->position))};
  const ox_neighbours_on_line found = ox_find_on_line(scene, second, entry, line, &self);
  if (found.are_many) return OX_NONE;
  // A stretch begins with every other. Of an odd number, as at the border of an open mesh, the last
  // goes with the one before it.
  return found.before % 2u == 0u && found.next.entry != OX_NONE ? found.next.entry
                                                                : found.last.entry;
}

// An end of the stretch that a crossing of an edge within a facet is on: of those of its facets the
// last before it, or where rounding puts it between two stretches the nearer; any where there are
// many, of which none has its other end; OX_NONE: there is none.
static inline uint ox_find_stretch_about(const ox_scene* scene, uint i) {
  __global const ox_feature* f = scene->features + i;
  const uint side = ox_side_of(f->flags);
  const uint facets = ox_find_feature(
      scene,
      ox_facets_key(f->pair, side, ox_facet_of(scene, f->at[0]), ox_facet_of(scene, f->triangle)));
  if (facets == OX_NONE) return OX_NONE;
  const uint first = facets >> 2 << 1 | (facets & 3u);
  const float3 line = ox_line_at(scene, f, 0u);
  const ox_on_line self = {i << 1, ox_dot(line, vload3(0, f->position))};
  const ox_neighbours_on_line found = ox_find_on_line(scene, first, first, line, &self);
  const ox_on_line last = found.last;
  const ox_on_line next = found.next;
  const bool is_between = found.before % 2u == 0u && next.entry != OX_NONE;
  return (last.entry == OX_NONE || (is_between && next.place - self.place < self.place - last.place)
              ? next.entry
              : last.entry) >>
         1;
}

// The mate of a crossing, of an edge of the other mesh; OX_NONE: it has none. Where facets are not
// quite flat two may see them in different orders: it is only where they agree.
static inline uint ox_mate_of(const ox_scene* scene, uint entry) {
  const uint mate = ox_find_other_end(scene, entry);
  if (mate == OX_NONE ||
      ox_side_of(scene->features[mate >> 1].flags) == ox_side_of(scene->features[entry >> 1].flags))
    return OX_NONE;
  return ox_find_other_end(scene, mate) == entry ? mate : OX_NONE;
}

#endif
