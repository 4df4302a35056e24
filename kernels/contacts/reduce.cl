// SPDX-License-Identifier: BSD-3-Clause
// Reduce: the candidates of each pair to a few contacts, of which every prefix is a good answer.
// The deepest of all, of each region, of each manifold; each time what is farthest from those
// taken, of those at least half as deep as the deepest left. Then whatever is left, the farthest
// first.
//
// in    candidates, found: those of each pair; pairs, meshes
// out   contacts, pair_ranges
// item  1 pair (of a queue); of a work-group, where lanes are one (lib/group.h)
// may overflow: OX_LIST_CONTACTS
#include "contacts/candidate_list.h"
#include "contacts/constants.h"
#include "lib/lanes.h"

// What one is taken for, one after the other: as the deepest of its region, or of its manifold, or
// for itself. Bits too, of candidates that do not come into question for that any more.
#define OX_FOR_REGION 0u
#define OX_FOR_MANIFOLD 1u
#define OX_FOR_ITSELF 2u

// What is looked for among those that come into question for something: the deepest, or what is
// farthest from those that are taken; of one region, or one manifold of it, or OX_NONE: of any.
typedef struct {
  uint what;
  bool deepest;
  float least_depth;  // [m] no less deep than that
  uint region, manifold;
} ox_criterion;

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

// [m] Half of how thick a closed mesh is across a normal in its frame: the least half size of its
// box, of axes that do not face that way. An open mesh is a surface: no two sides of it hold.
static float ox_half_across(__global const ox_mesh* mesh, float3 normal) {
  if ((mesh->flags & OX_MESH_CLOSED) == 0u) return INFINITY;
  const float3 half_size = vload3(0, mesh->box_half);
  const float3 along = fabs(normal);
  float least = INFINITY;
  if (along.x <= OX_SAME_WAY) least = ox_min(least, half_size.x);
  if (along.y <= OX_SAME_WAY) least = ox_min(least, half_size.y);
  if (along.z <= OX_SAME_WAY) least = ox_min(least, half_size.z);
  return least;
}

// [m] What is nearer than this to a contact with a normal, and faces the same way, holds no more
// than it. But both sides of a pane that stands do, however thin it is, and of what lies on a rail.
static float ox_merge_distance(const ox_scene* scene, uint p, float3 normal) {
  __global const ox_pair* pair = scene->pairs + p;
  __global const ox_mesh* a = scene->meshes + pair->mesh[0];
  __global const ox_mesh* b = scene->meshes + pair->mesh[1];
  const float across =
      ox_min(ox_half_across(a, ox_rotate(pair, 1u, normal)), ox_half_across(b, normal));
  return ox_min(OX_MERGE * ox_min(a->radius, b->radius), across);
}

// What candidates are to one that is taken: how far from it; of its region; of its manifold, or
// near it. The distance of those that face the same way is across their normal, since one above
// the other holds no more. That of those near it is none, so that of them the deepest is the next.
// What is near and faces another way comes into question for itself, after all else: at the foot
// of a wall the floor holds what the wall does not. But two that face one another in one place
// hold nothing: they jam.
static void ox_note_taken(const ox_scene* scene, uint pair, const ox_fields* list, uint count,
                          uint taken) {
  const float3 n = ox_vector_of(list, OX_CANDIDATE_NORMAL, taken);
  const float3 p = ox_vector_of(list, OX_CANDIDATE_POSITION, taken);
  const float merge = ox_merge_distance(scene, pair, n);
  const float merge2 = merge * merge;
  const int region = (int)ox_words_of(list, OX_CANDIDATE_REGION)[taken];
  const int manifold = (int)ox_words_of(list, OX_CANDIDATE_MANIFOLD)[taken];
  const ox_ints none = (ox_ints)(0);
  for (uint block = 0u; OX_VECTOR_WIDTH * block < count; ++block) {
    ox_floats x = OX_LOAD_FLOATS(list, OX_CANDIDATE_POSITION, block) - p.x;
    ox_floats y = OX_LOAD_FLOATS(list, OX_CANDIDATE_POSITION + 1u, block) - p.y;
    ox_floats z = OX_LOAD_FLOATS(list, OX_CANDIDATE_POSITION + 2u, block) - p.z;
    ox_floats cosine;
    ox_dot_fields(list, OX_CANDIDATE_NORMAL, block, n, &cosine);
    const ox_floats along = x * n.x + y * n.y + z * n.z;
    const ox_ints faces_same_way = cosine > OX_SAME_WAY;
    const ox_floats drop = faces_same_way ? along : (ox_floats)(0.0f);
    x -= drop * n.x;
    y -= drop * n.y;
    z -= drop * n.z;
    const ox_floats off2 = x * x + y * y + z * z;
    const ox_floats so_far = OX_LOAD_FLOATS(list, OX_CANDIDATE_DISTANCE2, block);
    const ox_ints of_region = OX_LOAD_WORDS(list, OX_CANDIDATE_REGION, block) == region;
    const ox_ints of_manifold =
        of_region & (OX_LOAD_WORDS(list, OX_CANDIDATE_MANIFOLD, block) == manifold);
    ox_ints flags = OX_LOAD_WORDS(list, OX_CANDIDATE_TAKEN, block);
    flags |= of_region ? none + (1 << OX_FOR_REGION) : none;
    const ox_ints is_near = off2 <= merge2;
    flags |= of_manifold | is_near ? none + (1 << OX_FOR_MANIFOLD) : none;
    const ox_ints adds_nothing = is_near & (faces_same_way | (cosine < -OX_SAME_WAY));
    flags |= adds_nothing ? none + (1 << OX_FOR_ITSELF) : none;
    const ox_floats apart2 = is_near ? (ox_floats)(0.0f) : off2;
    const ox_floats distance2 = OX_LESSER(apart2, so_far);
    OX_STORE_FLOATS(list, OX_CANDIDATE_DISTANCE2, block, count, distance2);
    OX_STORE_WORDS(list, OX_CANDIDATE_TAKEN, block, count, flags);
  }
}

// How good each of a block is for something; less than nothing: it does not come into question, as
// what is taken never does, since of its own region and manifold it is one, and near itself.
static void ox_rate(const ox_fields* list, uint count, uint block, const ox_criterion* criterion,
                    ox_floats* rating) {
  const ox_floats none = (ox_floats)(-1.0f);
  const uint by = criterion->deepest ? OX_CANDIDATE_DEPTH : OX_CANDIDATE_DISTANCE2;
  const ox_floats value = OX_LOAD_FLOATS(list, by, block);
  const ox_ints taken = OX_LOAD_WORDS(list, OX_CANDIDATE_TAKEN, block);
  const ox_ints left = (int)(count - OX_VECTOR_WIDTH * block) - OX_LANE_NUMBERS;
  const ox_floats depth = OX_LOAD_FLOATS(list, OX_CANDIDATE_DEPTH, block);
  ox_ints comes = (left > 0) & ((taken & (ox_ints)(1 << criterion->what)) == 0) &
                  (depth >= criterion->least_depth);
  if (criterion->region != OX_NONE)
    comes &= OX_LOAD_WORDS(list, OX_CANDIDATE_REGION, block) == (int)criterion->region;
  if (criterion->manifold != OX_NONE)
    comes &= OX_LOAD_WORDS(list, OX_CANDIDATE_MANIFOLD, block) == (int)criterion->manifold;
  *rating = comes ? value : none;
}

// Of as many blocks as are looked at at once.
static void ox_rate_blocks(const ox_fields* list, uint count, uint first,
                           const ox_criterion* criterion, ox_floats* ratings) {
  const uint last = (count - 1u) / OX_VECTOR_WIDTH;
  for (uint k = 0u; k < OX_BLOCKS_AT_ONCE; ++k)
    ox_rate(list, count, min(first + k, last), criterion, ratings + k);
}

// The best by a criterion; OX_NONE: there is none.
static uint ox_best_by(const ox_fields* list, uint count, const ox_criterion* criterion) {
  const uint blocks = (count + OX_VECTOR_WIDTH - 1u) / OX_VECTOR_WIDTH;
  ox_floats best = (ox_floats)(-1.0f);
  ox_floats rating[OX_BLOCKS_AT_ONCE];
  for (uint first = 0u; first < blocks; first += OX_BLOCKS_AT_ONCE) {
    ox_rate_blocks(list, count, first, criterion, rating);
    for (uint k = 0u; k < OX_BLOCKS_AT_ONCE; ++k) best = OX_GREATER(rating[k], best);
  }
  const float most = ox_greatest_of(&best);
  if (most < 0.0f) return OX_NONE;
  uint best_one = OX_NONE;
  for (uint first = 0u; first < blocks; first += OX_BLOCKS_AT_ONCE) {
    ox_rate_blocks(list, count, first, criterion, rating);
    for (uint k = 0u; k < OX_BLOCKS_AT_ONCE && first + k < blocks; ++k) {
      const ox_ints is = rating[k] == most;
      for (uint equal = ox_mask_of(&is); equal != 0u; equal &= equal - 1u) {
        const uint i = OX_VECTOR_WIDTH * (first + k) + ox_lowest(equal);
        if (best_one == OX_NONE || ox_comes_first(list, i, best_one)) best_one = i;
      }
    }
  }
  return best_one;
}

// The next for something. Of regions and of manifolds: of those that reach at least half as deep as
// the deepest that is left the one that comes farthest from what is taken, its deepest. So facets
// all round a seat, which are as deep, are held all round by any prefix, and what only touches does
// not come before what is to be pushed out. The first of all has nothing to be far from. OX_NONE:
// there is none.
static uint ox_next_for(const ox_fields* list, uint count, uint what, bool first) {
  ox_criterion criterion = {what, what != OX_FOR_ITSELF, 0.0f, OX_NONE, OX_NONE};
  const uint best = ox_best_by(list, count, &criterion);
  if (first || what == OX_FOR_ITSELF || best == OX_NONE) return best;
  criterion.deepest = false;
  criterion.least_depth = ox_floats_of(list, OX_CANDIDATE_DEPTH)[best] / OX_WORTH;
  const uint far = ox_best_by(list, count, &criterion);
  criterion.deepest = true;
  criterion.region = ox_words_of(list, OX_CANDIDATE_REGION)[far];
  if (what == OX_FOR_MANIFOLD) criterion.manifold = ox_words_of(list, OX_CANDIDATE_MANIFOLD)[far];
  return ox_best_by(list, count, &criterion);
}

static void ox_reduce_candidates(const ox_scene* scene) {
  const uint first = scene->pair_first;
  for (uint p = first + ox_next_item(scene, OX_QUEUE_REDUCE); p < scene->pair_end;
       p = first + ox_next_item(scene, OX_QUEUE_REDUCE)) {
    const uint count = scene->found[p].candidates;
    if (ox_is_first_item()) scene->pair_ranges[p].features = scene->found[p].features;
    if (count == 0u) continue;
    __global const ox_mesh* a = scene->meshes + scene->pairs[p].mesh[0];
    __global const ox_mesh* b = scene->meshes + scene->pairs[p].mesh[1];
    const ox_fields mine = ox_candidates_of(scene, p);
    const bool deformable = ((a->flags | b->flags) & OX_MESH_DEFORMABLE) != 0u;
    if (deformable && scene->max_deformable == 0u) {
      const uint room = ox_place_contacts(scene, count, scene->pair_ranges + p);
      for (uint i = 0u; i < room; ++i)
        ox_store_contact(&mine, i, scene->pairs + p,
                         scene->contacts + scene->pair_ranges[p].first + i);
      continue;
    }
    const uint most = deformable ? scene->max_deformable : scene->max_contacts;
    uint taken[OX_MAX_CONTACTS];
    uint n = 0u;
    // Where none comes into question for something, none ever will: bits are only added.
    for (uint what = OX_FOR_REGION; what <= OX_FOR_ITSELF && n < most;) {
      const uint next = ox_next_for(&mine, count, what, n == 0u);
      if (next == OX_NONE) {
        ++what;
        continue;
      }
      taken[n++] = next;
      if (n < most) ox_note_taken(scene, p, &mine, count, next);
      ox_settle();
    }
    const uint room = ox_place_contacts(scene, n, scene->pair_ranges + p);
    for (uint k = 0u; k < room; ++k)
      ox_store_contact(&mine, taken[k], scene->pairs + p,
                       scene->contacts + scene->pair_ranges[p].first + k);
  }
}

__kernel void reduce_candidates(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_reduce_candidates(&scene);
}
