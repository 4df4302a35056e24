// SPDX-License-Identifier: BSD-3-Clause
// Reduce: the candidates of each pair to a few contacts, of which every prefix is a good answer.
// The deepest of all, then of each region, then of each manifold, then whatever is farthest from
// those.
//
// in    candidates, found: those of each pair
// out   contacts, pair_ranges
// item  1 pair (of a queue)
// may overflow: OX_LIST_CONTACTS
#ifdef OX_PLANES
#include "shared/contact_store.h"
#include "shared/transform.h"

// What of a candidate is taken already.
#define OX_TAKEN_ITSELF 1u
#define OX_TAKEN_MANIFOLD 2u
#define OX_TAKEN_REGION 4u

// A total order: deeper, else by what does not depend on the order in which they came.
static bool ox_comes_first(__global const ox_candidate* a, __global const ox_candidate* b) {
  if (a->depth != b->depth) return a->depth > b->depth;
  for (uint k = 0u; k < 3u; ++k)
    if (a->position[k] != b->position[k]) return a->position[k] < b->position[k];
  if (a->side_kind != b->side_kind) return a->side_kind < b->side_kind;
  if (a->vertex != b->vertex) return a->vertex < b->vertex;
  if (a->triangle != b->triangle) return a->triangle < b->triangle;
  for (uint k = 0u; k < 3u; ++k)
    if (a->normal[k] != b->normal[k]) return a->normal[k] < b->normal[k];
  return false;
}

// How far two are apart; of those that face one way, within acos 0.9 = 26 degrees, across their
// normal: one above the other holds no more.
static float ox_apart2(__global const ox_candidate* a, __global const ox_candidate* b) {
  const float3 n = vload3(0, b->normal);
  float3 d = vload3(0, a->position) - vload3(0, b->position);
  if (ox_dot(n, vload3(0, a->normal)) > 0.9f) d -= ox_dot(d, n) * n;
  return ox_dot(d, d);
}

// The next to be taken, after `last`: OX_NONE: there is none.
static uint ox_next_candidate(__global ox_candidate* candidates, uint count, uint last,
                              float merge2) {
  uint best[3] = {OX_NONE, OX_NONE, OX_NONE};  // for its region, for its manifold, for its distance
  for (uint i = 0u; i < count; ++i) {
    __global ox_candidate* c = candidates + i;
    if (last == OX_NONE) {
      c->taken = 0u;
    } else {
      __global const ox_candidate* t = candidates + last;
      if (i == last) c->taken |= OX_TAKEN_ITSELF;
      if (c->region == t->region) c->taken |= OX_TAKEN_REGION;
      if (c->manifold == t->manifold) c->taken |= OX_TAKEN_MANIFOLD;
      c->distance2 = ox_min(c->distance2, ox_apart2(c, t));
    }
    if ((c->taken & OX_TAKEN_ITSELF) != 0u) continue;
    if ((c->taken & OX_TAKEN_REGION) == 0u) {
      if (best[0] == OX_NONE || ox_comes_first(c, candidates + best[0])) best[0] = i;
    } else if (c->distance2 > merge2) {
      if ((c->taken & OX_TAKEN_MANIFOLD) == 0u &&
          (best[1] == OX_NONE || ox_comes_first(c, candidates + best[1])))
        best[1] = i;
      if (best[2] == OX_NONE || c->distance2 > candidates[best[2]].distance2 ||
          (c->distance2 == candidates[best[2]].distance2 &&
           ox_comes_first(c, candidates + best[2])))
        best[2] = i;
    }
  }
  return best[0] != OX_NONE ? best[0] : best[1] != OX_NONE ? best[1] : best[2];
}

__kernel void reduce_candidates(OX_SCENE_PARAMETERS, __global ox_candidate* candidates,
                                uint max_contacts, uint max_deformable,
                                __global ox_range* pair_ranges, __global ox_contact* contacts) {
  const ox_scene scene = OX_SCENE;
  for (uint p = ox_next_item(&scene, OX_QUEUE_REDUCE); p < pair_count;
       p = ox_next_item(&scene, OX_QUEUE_REDUCE)) {
    const uint count = found[p].candidates;
    if (count == 0u) continue;
    __global const ox_mesh* a = meshes + pairs[p].mesh[0];
    __global const ox_mesh* b = meshes + pairs[p].mesh[1];
    __global ox_candidate* mine = candidates + found[p].first;
    const bool deformable = ((a->flags | b->flags) & OX_MESH_DEFORMABLE) != 0u;
    if (deformable && max_deformable == 0u) {
      const uint room = ox_place_contacts(&scene, count, pair_ranges + p);
      for (uint i = 0u; i < room; ++i)
        ox_store_contact(mine + i, contacts + pair_ranges[p].first + i);
      continue;
    }
    // Contacts closer than 2 % of the smaller mesh's radius hold it up no better than one.
    const float merge = 0.02f * ox_min(a->radius, b->radius);
    const uint most = deformable ? max_deformable : max_contacts;
    uint taken[OX_MAX_CONTACTS];
    uint n = 0u;
    for (uint last = OX_NONE; n < most; taken[n++] = last) {
      last = ox_next_candidate(mine, count, last, merge * merge);
      if (last == OX_NONE) break;
    }
    const uint room = ox_place_contacts(&scene, n, pair_ranges + p);
    for (uint k = 0u; k < room; ++k)
      ox_store_contact(mine + taken[k], contacts + pair_ranges[p].first + k);
  }
}
#endif
