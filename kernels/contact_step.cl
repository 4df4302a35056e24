// SPDX-License-Identifier: BSD-3-Clause
// Contact step: the hits of each pair, reduced to a few contacts of which every prefix is a good
// answer: the deepest, then the deepest of each other patch (facing another way), then those that
// spread the patches widest.
//
// Hits arrive in no particular order. Every choice (shared/patches.h) is a maximum under a total
// order that ends with side, position, vertex and, of points, the order in which they were added:
// the result is what hits sorted in that order would give.
#ifndef OX_PLANES
#include "shared/append.h"
#include "shared/patches.h"

// in: found. out: where the candidates and the crossings of each pair start, there. item: 1 pair.
// The counters cannot overflow: they end at the number of hits and a multiple of that of crossings,
// and at the number of crossings.
__kernel void contact_place(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  const uint stride = (uint)get_global_size(0);
  for (uint p = (uint)get_global_id(0); p < pair_count; p += stride) {
    const uint crossings = found[p].crossings;
    const uint most = found[p].hits + OX_POINTS_PER_CROSSING * crossings;
    if (most != 0u) found[p].first_candidate = ox_take_room(&scene, OX_COUNTER_SEGMENTS, most);
    if (crossings != 0u)
      found[p].first_crossing = ox_take_room(&scene, OX_COUNTER_CROSSED, crossings);
  }
}

// in: hits. out: candidates, by pair, in the frame of B. item: 1 hit.
__kernel void contact_gather(OX_SCENE_PARAMETERS, __global const ox_hit* hits,
                             __global ox_candidate* candidates) {
  const ox_scene scene = OX_SCENE;
  const uint hit_count = ox_length(&scene, OX_LIST_HITS);
  const uint stride = (uint)get_global_size(0);
  for (uint i = (uint)get_global_id(0); i < hit_count; i += stride) {
    __global const ox_hit* hit = hits + i;
    const uint p = hit->pair_side >> 1;
    const uint side = hit->pair_side & 1u;
    __global ox_candidate* candidate = candidates + found[p].first_candidate + hit->slot;
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
    candidate->listed = 0u;
  }
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

  ox_patches patches;
  ox_begin_patches(&patches, candidates, count, kind, epsilon);
  uint n = 0u;
  while (patches.left != 0u && n < max_contacts) {  // the deepest, and of each patch the deepest
    const uint best = ox_pop_deepest(&patches);
    if (edges && ox_drop_contradicted(&patches, best, patches.left)) continue;
    ox_open_patch(&patches, best, edges);
    taken[n++] = best;
  }
  // what alone speaks for a region; touches do not, as above
  if (n < max_contacts) ox_begin_regions(&patches, count);
  while (patches.left != 0u && n < max_contacts) {
    const uint best = ox_pop_deepest(&patches);
    if (ox_is_near(candidates, best, taken, n, merge2) || ox_drop_contradicted(&patches, best, 0u))
      continue;
    ox_take(&patches, best, candidates[best].patch);
    taken[n++] = best;
  }
  while (n < max_contacts) {  // whatever is farthest from what its patch has
    uint patch = 0u;
    const uint best = ox_farthest(&patches, &patch);
    if (best == OX_NONE || candidates[best].distance2 <= merge2) break;
    if (edges && ox_drop_contradicted(&patches, best, 0u)) continue;
    ox_take(&patches, best, patch);
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

static void ox_store_contact(__global const ox_candidate* candidate, __global ox_contact* contact) {
  contact->side_kind = candidate->side_kind & ~OX_HIT_STANDS;
  contact->vertex = candidate->vertex;
  contact->triangle = candidate->triangle;
  contact->depth = candidate->depth;
  vstore3(vload3(0, candidate->position), 0, contact->position);
  vstore3(vload3(0, candidate->normal), 0, contact->normal);
}

// Room for `count` contacts of pair p; less where the list is full.
static uint ox_place_contacts(const ox_scene* scene, uint count, __global ox_range* range) {
  const uint first = ox_take_room(scene, OX_LIST_CONTACTS, count);
  const uint capacity = scene->lists[OX_LIST_CONTACTS].capacity;
  range->first = first;
  range->count = min(count, first < capacity ? capacity - first : 0u);
  return range->count;
}

// in: candidates. out: contacts, pair_ranges. item: 1 pair, of a queue. max_deformable: of a pair
// with a deformable mesh; 0: all, in no order (the host sorts them). May overflow: OX_LIST_CONTACTS
__kernel void contact_reduce(OX_SCENE_PARAMETERS, __global ox_candidate* candidates,
                             uint max_contacts, uint max_deformable, __global ox_range* pair_ranges,
                             __global ox_contact* contacts) {
  const ox_scene scene = OX_SCENE;
  for (uint p = ox_next_item(&scene, OX_QUEUE_REDUCE); p < pair_count;
       p = ox_next_item(&scene, OX_QUEUE_REDUCE)) {
    const uint count = found[p].hits;
    if (count == 0u) continue;
    __global const ox_mesh* a = meshes + pairs[p].mesh[0];
    __global const ox_mesh* b = meshes + pairs[p].mesh[1];
    __global ox_candidate* mine = candidates + found[p].first_candidate;
    const bool deformable = ((a->flags | b->flags) & OX_MESH_DEFORMABLE) != 0u;
    if (deformable && max_deformable == 0u) {  // all that say most
      uint kind = OX_HIT_TOUCHING;
      for (uint i = 0u; i < count; ++i) kind = min(kind, ox_kind(mine + i));
      uint wanted = 0u;
      for (uint i = 0u; i < count; ++i) wanted += ox_kind(mine + i) == kind ? 1u : 0u;
      uint room = ox_place_contacts(&scene, wanted, pair_ranges + p);
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
    const uint n =
        ox_reduce(mine, count, merge * merge, pairs[p].epsilon,
                  deformable ? max_deformable : max_contacts, (modes & OX_MODE_EDGES) != 0u, taken);
    const uint room = ox_place_contacts(&scene, n, pair_ranges + p);
    for (uint k = 0u; k < room; ++k)
      ox_store_contact(mine + taken[k], contacts + pair_ranges[p].first + k);
  }
}
#endif
