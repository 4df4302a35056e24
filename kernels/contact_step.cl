// SPDX-License-Identifier: BSD-3-Clause
// Contact step: the hits of each pair, reduced to a few contacts of which every prefix is a good
// answer: the deepest, then the deepest of each other patch (facing another way), then those that
// spread the patches widest.
//
// Hits arrive in no particular order. Every choice below is a maximum under a total order that ends
// with (side, vertex), so the result is the one that hits sorted by (pair, side, vertex) would
// give.
#include "shared/transform.h"

#define OX_NO_PATCH 0xffffffffu
#define OX_TAKEN 0xfffffffeu

// in: pair_hits. out: pair_segments, where the candidates of each pair start. item: 1 pair.
// OX_COUNTER_SEGMENTS cannot overflow: it ends at the number of hits.
__kernel void contact_place(__global volatile uint* counters, __global const uint* pair_hits,
                            uint pair_count, __global uint* pair_segments) {
  const uint stride = (uint)get_global_size(0);
  for (uint p = (uint)get_global_id(0); p < pair_count; p += stride)
    if (pair_hits[p] != 0u)
      pair_segments[p] =
          atomic_add(counters + OX_COUNTER_SEGMENTS * OX_COUNTER_STRIDE, pair_hits[p]);
}

// in: hits (counter OX_COUNTER_HITS). out: candidates, by pair, in the frame of B. item: 1 hit.
__kernel void contact_gather(__global const uint* counters, __global const ox_hit* hits,
                             uint hit_capacity, __global const ox_pair* pairs,
                             __global const ox_vertex* vertices,
                             __global const ox_triangle* triangles,
                             __global const uint* pair_segments,
                             __global ox_candidate* candidates) {
  const uint hit_count = min(counters[OX_COUNTER_HITS * OX_COUNTER_STRIDE], hit_capacity);
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < hit_count; i += stride) {
    __global const ox_hit* hit = hits + i;
    const uint p = hit->pair_side >> 1;
    const uint side = hit->pair_side & 1u;
    __global ox_candidate* candidate = candidates + pair_segments[p] + hit->slot;
    float3 position = vload3(0, vertices[hit->vertex].position);
    float3 normal = vload3(0, triangles[hit->triangle].normal);
    if (side == 0u) {
      position = ox_place(pairs + p, 0u, position);
    } else {
      normal = -ox_turn(pairs + p, 0u, normal);  // out of A in A's frame -> into A in B's
    }
    vstore3(position, 0, candidate->position);
    vstore3(normal, 0, candidate->normal);
    candidate->depth = hit->depth;
    candidate->t = hit->t;
    candidate->side_kind = side << 2 | hit->kind;
    candidate->vertex = hit->vertex;
    candidate->triangle = hit->triangle;
    candidate->patch = OX_NO_PATCH;
    candidate->distance2 = INFINITY;
  }
}

static uint ox_kind(__global const ox_candidate* c) { return c->side_kind & 3u; }

static bool ox_key_less(__global const ox_candidate* a, __global const ox_candidate* b) {
  const uint side_a = a->side_kind >> 2;
  const uint side_b = b->side_kind >> 2;
  return side_a != side_b ? side_a < side_b : a->vertex < b->vertex;
}

static bool ox_deeper(__global const ox_candidate* a, __global const ox_candidate* b) {
  return a->depth != b->depth ? a->depth > b->depth : ox_key_less(a, b);
}

static bool ox_farther(__global const ox_candidate* a, __global const ox_candidate* b) {
  return a->distance2 != b->distance2 ? a->distance2 > b->distance2 : ox_deeper(a, b);
}

static float ox_distance2(__global const ox_candidate* a, __global const ox_candidate* b) {
  const float3 d = vload3(0, a->position) - vload3(0, b->position);
  return ox_dot(d, d);
}

// Takes a candidate: its patch learns how far each of its members is from what was taken of it.
static void ox_take(__global ox_candidate* candidates, uint count, uint taken) {
  const uint patch = candidates[taken].patch;
  for (uint i = 0u; i < count; ++i) {
    __global ox_candidate* c = candidates + i;
    if (c->patch == patch) c->distance2 = ox_min(c->distance2, ox_distance2(c, candidates + taken));
  }
  candidates[taken].patch = OX_TAKEN;
}

// A new patch: all that are in none and face the way of `best`, within acos 0.9 = 25.8 degrees.
static void ox_open_patch(__global ox_candidate* candidates, uint count, uint best, uint patch) {
  const float3 normal = vload3(0, candidates[best].normal);
  for (uint i = 0u; i < count; ++i)
    if (candidates[i].patch == OX_NO_PATCH &&
        (i == best || ox_dot(vload3(0, candidates[i].normal), normal) > 0.9f))
      candidates[i].patch = patch;
}

static uint ox_reduce(__global ox_candidate* candidates, uint count, float merge2,
                      uint max_contacts, uint* taken) {
  // Contacts within the source's exit say most; those beyond it speak only where there are none,
  // and touches only where a pair has nothing else.
  uint kind = OX_HIT_TOUCHING;
  for (uint i = 0u; i < count; ++i) kind = min(kind, ox_kind(candidates + i));

  uint n = 0u;
  while (n < max_contacts) {  // the deepest, and of each patch the deepest
    uint best = count;
    for (uint i = 0u; i < count; ++i)
      if (candidates[i].patch == OX_NO_PATCH && ox_kind(candidates + i) == kind &&
          (best == count || ox_deeper(candidates + i, candidates + best)))
        best = i;
    if (best == count) break;
    ox_open_patch(candidates, count, best, n);
    ox_take(candidates, count, best);
    taken[n++] = best;
  }
  while (n < max_contacts) {  // whatever is farthest from what its patch has
    uint best = count;
    for (uint i = 0u; i < count; ++i)
      if (candidates[i].patch != OX_TAKEN && ox_kind(candidates + i) == kind &&
          (best == count || ox_farther(candidates + i, candidates + best)))
        best = i;
    if (best == count || candidates[best].distance2 <= merge2) break;
    ox_take(candidates, count, best);
    taken[n++] = best;
  }
  while (kind == OX_HIT_INSIDE &&
         n < max_contacts) {  // deep vertices in a region with none of those
    uint best = count;
    for (uint i = 0u; i < count; ++i) {
      __global const ox_candidate* c = candidates + i;
      if (c->patch == OX_TAKEN || ox_kind(c) != OX_HIT_FALLBACK ||
          (best != count && !ox_deeper(c, candidates + best)))
        continue;
      const float apart2 = ox_max(merge2, c->t * c->t);
      bool alone = true;
      for (uint k = 0u; k < n && alone; ++k)
        alone = ox_distance2(c, candidates + taken[k]) > apart2;
      if (alone) best = i;
    }
    if (best == count) break;
    candidates[best].patch = OX_TAKEN;
    taken[n++] = best;
  }
  return n;
}

#define OX_MAX_CONTACTS 64u

// in: candidates. out: contacts, pair_ranges. item: 1 pair. May overflow: OX_COUNTER_CONTACTS
__kernel void contact_reduce(__global volatile uint* counters, __global const ox_pair* pairs,
                             __global const ox_mesh* meshes, __global const uint* pair_hits,
                             __global const uint* pair_segments, uint pair_count,
                             __global ox_candidate* candidates, uint hit_capacity,
                             uint max_contacts, __global ox_range* pair_ranges,
                             __global ox_contact* contacts, uint capacity) {
  // With hits lost the segments are not whole; the host redoes the step.
  if (counters[OX_COUNTER_HITS * OX_COUNTER_STRIDE] > hit_capacity) return;
  const uint stride = (uint)get_global_size(0);
  for (uint p = (uint)get_global_id(0); p < pair_count; p += stride) {
    const uint count = pair_hits[p];
    if (count == 0u) continue;
    __global const ox_mesh* a = meshes + pairs[p].mesh[0];
    __global const ox_mesh* b = meshes + pairs[p].mesh[1];
    // Contacts closer than 2 % of the smaller mesh's radius hold it up no better than one.
    const float merge = 0.02f * ox_min(a->radius, b->radius);
    __global ox_candidate* mine = candidates + pair_segments[p];
    uint taken[OX_MAX_CONTACTS];
    const uint n = ox_reduce(mine, count, merge * merge, max_contacts, taken);
    const uint first = atomic_add(counters + OX_COUNTER_CONTACTS * OX_COUNTER_STRIDE, n);
    pair_ranges[p].first = first;
    pair_ranges[p].count = n;
    for (uint k = 0u; k < n && first + k < capacity; ++k) {
      contacts[first + k].side = mine[taken[k]].side_kind >> 2;
      contacts[first + k].vertex = mine[taken[k]].vertex;
      contacts[first + k].triangle = mine[taken[k]].triangle;
      contacts[first + k].depth = mine[taken[k]].depth;
    }
  }
}
