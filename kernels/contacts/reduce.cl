// SPDX-License-Identifier: BSD-3-Clause
// Reduce: the candidates of each pair to a few contacts, of which every prefix is a good answer.
// The deepest of all, then of each region, then of each manifold, then whatever is farthest from
// those.
//
// in    candidates, found: those of each pair
// out   contacts, pair_ranges
// item  1 pair (of a queue)
// may overflow: OX_LIST_CONTACTS
#include "contacts/candidate_list.h"
#include "lib/lanes.h"

// What of a candidate is taken already.
#define OX_TAKEN_ITSELF 1
#define OX_TAKEN_MANIFOLD 2
#define OX_TAKEN_REGION 4

// Of candidates that are as good: a total order by what does not depend on the order in which they
// came.
static bool ox_comes_first(const ox_fields* list, uint a, uint b) {
  __global const float* depth = ox_floats_of(list, OX_CANDIDATE_DEPTH);
  if (depth[a] != depth[b]) return depth[a] > depth[b];
  for (uint field = OX_CANDIDATE_POSITION; field < OX_CANDIDATE_POSITION + 3u; ++field) {
    __global const float* values = ox_floats_of(list, field);
    if (values[a] != values[b]) return values[a] < values[b];
  }
  for (uint field = OX_CANDIDATE_SIDE_KIND; field <= OX_CANDIDATE_TRIANGLE; ++field) {
    __global const uint* values = ox_words_of(list, field);
    if (values[a] != values[b]) return values[a] < values[b];
  }
  for (uint field = OX_CANDIDATE_NORMAL; field < OX_CANDIDATE_NORMAL + 3u; ++field) {
    __global const float* values = ox_floats_of(list, field);
    if (values[a] != values[b]) return values[a] < values[b];
  }
  // Where edges meet on a face several cross it in one place, and all else of them is equal.
  for (uint field = OX_CANDIDATE_FEATURE; field < OX_CANDIDATE_FEATURE + 2u; ++field) {
    __global const uint* values = ox_words_of(list, field);
    if (values[a] != values[b]) return values[a] < values[b];
  }
  return false;
}

// A block of candidates.
typedef struct {
  ox_ints taken;
  ox_floats depth, distance2;
} ox_candidate_block;

// How far those of a block are from one that is taken; of those that face its way, within acos 0.9
// = 26 degrees, across their normal: one above the other holds no more.
static void ox_note_taken(const ox_fields* list, uint count, uint block, uint taken,
                          ox_candidate_block* b) {
  const float3 n = ox_vector_of(list, OX_CANDIDATE_NORMAL, taken);
  const float3 p = ox_vector_of(list, OX_CANDIDATE_POSITION, taken);
  ox_floats x = OX_LOAD_FLOATS(list, OX_CANDIDATE_POSITION, block) - p.x;
  ox_floats y = OX_LOAD_FLOATS(list, OX_CANDIDATE_POSITION + 1u, block) - p.y;
  ox_floats z = OX_LOAD_FLOATS(list, OX_CANDIDATE_POSITION + 2u, block) - p.z;
  ox_floats cosine;
  ox_dot_fields(list, OX_CANDIDATE_NORMAL, block, n, &cosine);
  const ox_floats along = x * n.x + y * n.y + z * n.z;
  const ox_floats drop = cosine > 0.9f ? along : (ox_floats)(0.0f);
  x -= drop * n.x;
  y -= drop * n.y;
  z -= drop * n.z;
  const ox_floats off2 = x * x + y * y + z * z;
  b->distance2 = OX_LESSER(off2, b->distance2);
  const int region = (int)ox_words_of(list, OX_CANDIDATE_REGION)[taken];
  const int manifold = (int)ox_words_of(list, OX_CANDIDATE_MANIFOLD)[taken];
  const ox_ints none = (ox_ints)(0);
  const ox_ints of_region = OX_LOAD_WORDS(list, OX_CANDIDATE_REGION, block) == region;
  const ox_ints of_manifold =
      of_region & (OX_LOAD_WORDS(list, OX_CANDIDATE_MANIFOLD, block) == manifold);
  b->taken |= of_region ? (ox_ints)(OX_TAKEN_REGION) : none;
  b->taken |= of_manifold ? (ox_ints)(OX_TAKEN_MANIFOLD) : none;
  float distance2[OX_VECTOR_WIDTH];
  int flags[OX_VECTOR_WIDTH];
  ox_store(b->distance2, 0, distance2);
  ox_store_ints(b->taken, 0, flags);
  const uint present = min(count - OX_VECTOR_WIDTH * block, (uint)OX_VECTOR_WIDTH);
  for (uint k = 0u; k < present; ++k) {
    ox_floats_of(list, OX_CANDIDATE_DISTANCE2)[OX_VECTOR_WIDTH * block + k] = distance2[k];
    ox_words_of(list, OX_CANDIDATE_TAKEN)[OX_VECTOR_WIDTH * block + k] = (uint)flags[k];
  }
}

// What one is taken for: as the deepest of its region, or of its manifold, or for its distance.
#define OX_FOR_REGION 0u
#define OX_FOR_MANIFOLD 1u
#define OX_FOR_DISTANCE 2u

// How good each of a block is for that; less than nothing: it does not come into question.
static void ox_rate(const ox_candidate_block* b, uint what, float merge2, ox_floats* rating) {
  const int flags =
      OX_TAKEN_ITSELF | OX_TAKEN_REGION | (what == OX_FOR_MANIFOLD ? OX_TAKEN_MANIFOLD : 0);
  const int wanted = what == OX_FOR_REGION ? 0 : OX_TAKEN_REGION;
  const ox_floats value = what == OX_FOR_DISTANCE ? b->distance2 : b->depth;
  const ox_floats none = (ox_floats)(-1.0f);
  *rating = (b->taken & flags) == wanted ? value : none;
  if (what != OX_FOR_REGION) *rating = b->distance2 > merge2 ? *rating : none;
}

// The next to be taken, after `last`: OX_NONE: there is none.
static uint ox_next_candidate(const ox_fields* list, uint count, uint last, float merge2) {
  ox_floats best[3];
  for (uint what = 0u; what < 3u; ++what) best[what] = (ox_floats)(-1.0f);
  if (last != OX_NONE) ox_words_of(list, OX_CANDIDATE_TAKEN)[last] |= OX_TAKEN_ITSELF;
  for (uint block = 0u; OX_VECTOR_WIDTH * block < count; ++block) {
    ox_candidate_block b;
    b.taken = OX_LOAD_WORDS(list, OX_CANDIDATE_TAKEN, block);
    b.depth = OX_LOAD_FLOATS(list, OX_CANDIDATE_DEPTH, block);
    b.distance2 = OX_LOAD_FLOATS(list, OX_CANDIDATE_DISTANCE2, block);
    if (last != OX_NONE) ox_note_taken(list, count, block, last, &b);
    const ox_ints left = (int)(count - OX_VECTOR_WIDTH * block) - OX_LANE_NUMBERS;
    for (uint what = 0u; what < 3u; ++what) {
      ox_floats rating;
      ox_rate(&b, what, merge2, &rating);
      rating = left > 0 ? rating : (ox_floats)(-1.0f);
      best[what] = OX_GREATER(rating, best[what]);
    }
  }
  for (uint what = 0u; what < 3u; ++what) {
    const float most = ox_greatest_of(best + what);
    if (most < 0.0f) continue;
    uint first = OX_NONE;
    for (uint block = 0u; OX_VECTOR_WIDTH * block < count; ++block) {
      ox_candidate_block b;
      b.taken = OX_LOAD_WORDS(list, OX_CANDIDATE_TAKEN, block);
      b.depth = OX_LOAD_FLOATS(list, OX_CANDIDATE_DEPTH, block);
      b.distance2 = OX_LOAD_FLOATS(list, OX_CANDIDATE_DISTANCE2, block);
      ox_floats rating;
      ox_rate(&b, what, merge2, &rating);
      const ox_ints is = rating == most;
      uint equal = ox_mask_of(&is) & ox_present_lanes(count, block);
      for (; equal != 0u; equal &= equal - 1u) {
        const uint i = OX_VECTOR_WIDTH * block + ox_lowest(equal);
        if (first == OX_NONE || ox_comes_first(list, i, first)) first = i;
      }
    }
    return first;
  }
  return OX_NONE;
}

static void ox_reduce_candidates(const ox_scene* scene, __global float* candidates,
                                 uint max_contacts, uint max_deformable,
                                 __global ox_range* pair_ranges, __global ox_contact* contacts) {
  const uint first = scene->pair_first;
  for (uint p = first + ox_next_item(scene, OX_QUEUE_REDUCE); p < scene->pair_end;
       p = first + ox_next_item(scene, OX_QUEUE_REDUCE)) {
    const uint count = scene->found[p].candidates;
    if (count == 0u) continue;
    __global const ox_mesh* a = scene->meshes + scene->pairs[p].mesh[0];
    __global const ox_mesh* b = scene->meshes + scene->pairs[p].mesh[1];
    const ox_fields mine = ox_candidates_of(scene, p, candidates);
    const bool deformable = ((a->flags | b->flags) & OX_MESH_DEFORMABLE) != 0u;
    if (deformable && max_deformable == 0u) {
      const uint room = ox_place_contacts(scene, count, pair_ranges + p);
      for (uint i = 0u; i < room; ++i)
        ox_store_contact(&mine, i, contacts + pair_ranges[p].first + i);
      continue;
    }
    // Contacts closer than 2 % of the smaller mesh's radius hold it up no better than one.
    const float merge = 0.02f * ox_min(a->radius, b->radius);
    const uint most = deformable ? max_deformable : max_contacts;
    uint taken[OX_MAX_CONTACTS];
    uint n = 0u;
    for (uint last = OX_NONE; n < most; taken[n++] = last) {
      last = ox_next_candidate(&mine, count, last, merge * merge);
      if (last == OX_NONE) break;
    }
    const uint room = ox_place_contacts(scene, n, pair_ranges + p);
    for (uint k = 0u; k < room; ++k)
      ox_store_contact(&mine, taken[k], contacts + pair_ranges[p].first + k);
  }
}

__kernel void reduce_candidates(OX_SCENE_PARAMETERS, __global float* candidates, uint max_contacts,
                                uint max_deformable, __global ox_range* pair_ranges,
                                __global ox_contact* contacts) {
  const ox_scene scene = OX_SCENE;
  ox_reduce_candidates(&scene, candidates, max_contacts, max_deformable, pair_ranges, contacts);
}
