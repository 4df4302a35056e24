// SPDX-License-Identifier: BSD-3-Clause
// Contact step: the hits of each pair, reduced to a few contacts of which every prefix is a good
// answer: the deepest, then the deepest of each other patch (facing another way), then those that
// spread the patches widest.
//
// Hits arrive in no particular order. Every choice below is a maximum under a total order that ends
// with (side, position, vertex), so the result is what hits sorted in that order would give.
#include "shared/append.h"
#include "shared/candidate_order.h"

#define OX_NO_PATCH 0xffffffffu
#define OX_TAKEN 0xfffffffeu
#define OX_DROPPED 0xfffffffdu

// in: pair_hits, pair_crossings. out: where the candidates and the crossings of each pair start.
// item: 1 pair. The counters cannot overflow: they end at the number of hits and a multiple of
// that of crossings, and at the number of crossings.
__kernel void contact_place(__global volatile uint* counters, __global const uint* pair_hits,
                            __global const uint* pair_crossings, uint pair_count,
                            __global uint* pair_segments, __global uint* crossing_segments) {
  const uint stride = (uint)get_global_size(0);
  for (uint p = (uint)get_global_id(0); p < pair_count; p += stride) {
    const uint crossings = pair_crossings[p];
    const uint most = pair_hits[p] + OX_POINTS_PER_CROSSING * crossings;
    if (most != 0u)
      pair_segments[p] = atomic_add(counters + OX_COUNTER_SEGMENTS * OX_COUNTER_STRIDE, most);
    if (crossings != 0u)
      crossing_segments[p] =
          atomic_add(counters + OX_COUNTER_CROSSED * OX_COUNTER_STRIDE, crossings);
  }
}

// in: hits. out: candidates, by pair, in the frame of B. item: 1 hit.
__kernel void contact_gather(__global const uint* counters, __global const ox_list* lists,
                             __global const ox_hit* hits, __global const ox_pair* pairs,
                             __global const ox_vertex* vertices,
                             __global const ox_triangle* triangles,
                             __global const uint* pair_segments,
                             __global ox_candidate* candidates) {
  const uint hit_count = ox_length(counters, lists, OX_LIST_HITS);
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < hit_count; i += stride) {
    __global const ox_hit* hit = hits + i;
    const uint p = hit->pair_side >> 1;
    const uint side = hit->pair_side & 1u;
    __global ox_candidate* candidate = candidates + pair_segments[p] + hit->slot;
    float3 position = vload3(0, vertices[hit->vertex].position);
    float3 normal = vload3(0, triangles[hit->triangle].normal);
    if ((hit->kind & OX_HIT_REVERSED) != 0u) normal = -normal;
    if (side == 0u) {
      position = ox_place(pairs + p, 0u, position);
    } else {
      normal = -ox_turn(pairs + p, 0u, normal);  // out of A in A's frame -> into A in B's
    }
    vstore3(position, 0, candidate->position);
    vstore3(normal, 0, candidate->normal);
    candidate->depth = hit->depth;
    candidate->t = hit->t;
    candidate->side_kind = (side != 0u ? OX_HIT_SIDE : 0u) | hit->kind;
    candidate->vertex = hit->vertex;
    candidate->triangle = hit->triangle;
    candidate->patch = OX_NO_PATCH;
    candidate->distance2 = INFINITY;
    candidate->region = OX_NONE;
    candidate->marks = 0u;
  }
}

static bool ox_is_left(__global const ox_candidate* c) {
  return c->patch != OX_TAKEN && c->patch != OX_DROPPED;
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

// The outline of a patch, seen along its normal: what is farthest in each of eight directions, the
// first of them from the deepest to the farthest from it. A point within bears nothing that these
// do not, and costs the solver as much.
static void ox_mark_outline(__global ox_candidate* candidates, uint count, uint kind, uint patch,
                            uint deepest) {
  const float3 normal = vload3(0, candidates[deepest].normal);
  float3 across = (float3)(0.0f);
  uint far = deepest;
  float far2 = 0.0f;
  for (uint i = 0u; i < count; ++i) {
    __global const ox_candidate* c = candidates + i;
    if (c->patch != patch || ox_kind(c) != kind) continue;
    const float distance2 = ox_distance2(c, candidates + deepest);
    if (distance2 < far2 || (distance2 == far2 && !ox_key_less(c, candidates + far))) continue;
    const float3 d = vload3(0, c->position) - vload3(0, candidates[deepest].position);
    across = d - ox_dot(d, normal) * normal;
    far = i;
    far2 = distance2;
  }
  const float width2 = ox_dot(across, across);
  if (!(width2 > 0.0f)) return;  // it is the only one, or all lie behind it
  const float3 u = across / sqrt(width2);
  const float3 v = ox_plain_cross(normal, u);
  float3 direction[8];
  uint best[8];
  float farthest[8];
  for (uint k = 0u; k < 8u; ++k) {
    const float a = k == 0u || k == 4u ? 1.0f : k == 2u || k == 6u ? 0.0f : 0.70710678f;
    const float b = k == 0u || k == 4u ? 0.0f : k == 2u || k == 6u ? 1.0f : 0.70710678f;
    direction[k] = (k > 2u && k < 6u ? -a : a) * u + (k > 4u || k == 4u ? -b : b) * v;
    best[k] = count;
    farthest[k] = -INFINITY;
  }
  for (uint i = 0u; i < count; ++i) {
    __global const ox_candidate* c = candidates + i;
    if (c->patch != patch || ox_kind(c) != kind) continue;
    for (uint k = 0u; k < 8u; ++k) {
      const float reach = ox_dot(vload3(0, c->position), direction[k]);
      if (best[k] != count && !(reach > farthest[k]) &&
          !(reach == farthest[k] && ox_key_less(c, candidates + best[k])))
        continue;
      best[k] = i;
      farthest[k] = reach;
    }
  }
  for (uint k = 0u; k < 8u; ++k)
    if (best[k] != count) candidates[best[k]].marks |= OX_MARK_OUTLINE;
}

static bool ox_gives_way(__global const ox_candidate* candidates, float epsilon,
                         __global const ox_candidate* c, uint to) {
  __global const ox_candidate* d = candidates + candidates[to].ordered;
  return d->patch != OX_DROPPED &&
         ((c->marks & OX_MARK_STANDS) == 0u || (d->marks & OX_MARK_STANDS) != 0u) &&
         ox_contradicts(c, d, epsilon);
}

// Whether the candidate at `rank` in the order of depths contradicts a shallower one that is not
// dropped; it is dropped then. One that does not is taken, and few are; those that do have to be
// found fast: by what the last one contradicted (`contradictor`, a rank), else among those that are
// about as deep (in thick parts) and the shallowest (in thin ones) by turns.
static bool ox_is_contradicted(__global ox_candidate* candidates, uint count, float epsilon,
                               uint rank, uint* contradictor) {
  __global ox_candidate* c = candidates + candidates[rank].ordered;
  bool found = *contradictor > rank && ox_gives_way(candidates, epsilon, c, *contradictor);
  for (uint k = 0u; k + 1u < count - rank && !found; ++k) {
    const uint at = (k & 1u) == 0u ? rank + 1u + k / 2u : count - 1u - k / 2u;
    found = ox_gives_way(candidates, epsilon, c, at);
    if (found) *contradictor = at;
  }
  if (found) c->patch = OX_DROPPED;
  return found;
}

static bool ox_is_near(__global const ox_candidate* candidates, uint candidate, const uint* taken,
                       uint n, float merge2) {
  for (uint k = 0u; k < n; ++k)
    if (ox_distance2(candidates + candidate, candidates + taken[k]) <= merge2) return true;
  return false;
}

// edges: every region has a contact, and what lies beyond a source's exit says nothing more.
static uint ox_reduce(__global ox_candidate* candidates, uint count, float merge2, float epsilon,
                      uint max_contacts, bool edges, uint* taken) {
  // Contacts within the source's exit say most; those beyond it speak only where there are none,
  // and touches only where a pair has nothing else.
  uint kind = OX_HIT_TOUCHING;
  for (uint i = 0u; i < count; ++i) kind = min(kind, ox_kind(candidates + i));

  const uint ordered = ox_order_by_depth(candidates, count, kind);
  uint contradictor = 0u;
  uint n = 0u;
  // the deepest, and of each patch the deepest
  for (uint rank = 0u; rank < ordered && n < max_contacts; ++rank) {
    const uint best = candidates[rank].ordered;
    if (candidates[best].patch != OX_NO_PATCH ||
        (edges && ox_is_contradicted(candidates, ordered, epsilon, rank, &contradictor)))
      continue;
    ox_open_patch(candidates, count, best, n);
    if (edges) ox_mark_outline(candidates, count, kind, n, best);
    ox_take(candidates, count, best);
    taken[n++] = best;
  }
  // what alone speaks for a region; touches do not, as above
  for (uint rank = 0u; rank < ordered && n < max_contacts; ++rank) {
    const uint best = candidates[rank].ordered;
    if (!ox_is_left(candidates + best) || candidates[best].region == OX_NONE ||
        ox_is_near(candidates, best, taken, n, merge2) ||
        ox_is_contradicted(candidates, ordered, epsilon, rank, &contradictor))
      continue;
    ox_take(candidates, count, best);
    taken[n++] = best;
  }
  while (n < max_contacts) {  // whatever is farthest from what its patch has
    uint best = count;
    uint best_rank = ordered;
    for (uint rank = 0u; rank < ordered; ++rank) {
      const uint i = candidates[rank].ordered;
      if (!ox_is_left(candidates + i) || (edges && (candidates[i].marks & OX_MARK_OUTLINE) == 0u) ||
          (best != count && !ox_farther(candidates + i, candidates + best)))
        continue;
      best = i;
      best_rank = rank;
    }
    if (best == count || candidates[best].distance2 <= merge2) break;
    if (edges && ox_is_contradicted(candidates, ordered, epsilon, best_rank, &contradictor))
      continue;
    ox_take(candidates, count, best);
    taken[n++] = best;
  }
  while (kind == OX_HIT_INSIDE && !edges &&
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

static void ox_store_contact(__global const ox_candidate* candidate, __global ox_contact* contact) {
  contact->side_kind = candidate->side_kind;
  contact->vertex = candidate->vertex;
  contact->triangle = candidate->triangle;
  contact->depth = candidate->depth;
  vstore3(vload3(0, candidate->position), 0, contact->position);
  vstore3(vload3(0, candidate->normal), 0, contact->normal);
}

// Room for `count` contacts of pair p; less where the list is full.
static uint ox_place_contacts(__global volatile uint* counters, __global const ox_list* lists,
                              uint count, __global ox_range* range) {
  const uint first = atomic_add(counters + OX_LIST_CONTACTS * OX_COUNTER_STRIDE, count);
  const uint capacity = lists[OX_LIST_CONTACTS].capacity;
  range->first = first;
  range->count = min(count, first < capacity ? capacity - first : 0u);
  return range->count;
}

// in: candidates. out: contacts, pair_ranges. item: 1 pair. max_deformable: of a pair with a
// deformable mesh; 0: all, in no order (the host sorts them). May overflow: OX_LIST_CONTACTS
__kernel void contact_reduce(__global volatile uint* counters, __global const ox_list* lists,
                             __global const ox_pair* pairs, __global const ox_mesh* meshes,
                             __global const uint* pair_hits, __global const uint* pair_segments,
                             uint pair_count, __global ox_candidate* candidates, uint max_contacts,
                             uint max_deformable, uint rays_mode, __global ox_range* pair_ranges,
                             __global ox_contact* contacts) {
  const uint stride = (uint)get_global_size(0);
  for (uint p = (uint)get_global_id(0); p < pair_count; p += stride) {
    const uint count = pair_hits[p];
    if (count == 0u) continue;
    __global const ox_mesh* a = meshes + pairs[p].mesh[0];
    __global const ox_mesh* b = meshes + pairs[p].mesh[1];
    __global ox_candidate* mine = candidates + pair_segments[p];
    const bool deformable = ((a->flags | b->flags) & OX_MESH_DEFORMABLE) != 0u;
    if (deformable && max_deformable == 0u) {  // all that say most
      uint kind = OX_HIT_TOUCHING;
      for (uint i = 0u; i < count; ++i) kind = min(kind, ox_kind(mine + i));
      uint wanted = 0u;
      for (uint i = 0u; i < count; ++i) wanted += ox_kind(mine + i) == kind ? 1u : 0u;
      uint room = ox_place_contacts(counters, lists, wanted, pair_ranges + p);
      __global ox_contact* contact = contacts + pair_ranges[p].first;
      for (uint i = 0u; i < count && room != 0u; ++i) {
        if (ox_kind(mine + i) != kind) continue;
        ox_store_contact(mine + i, contact++);
        --room;
      }
      continue;
    }
    // Contacts closer than 2 % of the smaller mesh's radius hold it up no better than one.
    const float merge = 0.02f * ox_min(a->radius, b->radius);
    uint taken[OX_MAX_CONTACTS];
    const uint n = ox_reduce(mine, count, merge * merge, pairs[p].epsilon,
                             deformable ? max_deformable : max_contacts,
                             (rays_mode & OX_RAYS_EDGES) != 0u, taken);
    const uint room = ox_place_contacts(counters, lists, n, pair_ranges + p);
    for (uint k = 0u; k < room; ++k)
      ox_store_contact(mine + taken[k], contacts + pair_ranges[p].first + k);
  }
}
