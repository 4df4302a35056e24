// SPDX-License-Identifier: BSD-3-Clause
// Patches: the candidates of a kind that face one way, that of the deepest that is in no other,
// within acos 0.9 = 25.8 degrees. What is looked for is looked for among those in no patch yet, in
// one patch, or among the few of it that may become contacts: seldom among all. Device only.
#ifndef OX_PLANES
#ifndef ODE_EXT_KERNELS_SHARED_PATCHES_H
#define ODE_EXT_KERNELS_SHARED_PATCHES_H

#include "shared/candidate_order.h"

#define OX_NO_PATCH 0xffffffffu
#define OX_TAKEN 0xfffffffeu
#define OX_DROPPED 0xfffffffdu

#define OX_MAX_CONTACTS 64u

typedef struct {
  __global ox_candidate* candidates;
  // Those in no patch, and after those the contacts chosen for regions, in `ordered` of the first
  // of them: a heap by depth.
  uint left;
  // Those in patches, in `listed` of the first of them: patch by patch, in each first what may
  // become a contact. Its deepest gave a patch its normal.
  uint patches;
  uint deepest[OX_MAX_CONTACTS];
  uint begin[OX_MAX_CONTACTS + 1u];
  uint contenders[OX_MAX_CONTACTS];
  uint found[OX_MAX_CONTACTS];  // where in each the last contradictor was
  uint contradictor;            // that was found last
  float epsilon;
} ox_patches;

static inline void ox_sift_down(const ox_patches* p, uint root) {
  __global ox_candidate* candidates = p->candidates;
  const uint sifted = candidates[root].ordered;
  for (uint child = 2u * root + 1u; child < p->left; child = 2u * root + 1u) {
    if (child + 1u < p->left &&
        ox_is_ordered_before(candidates, candidates[child + 1u].ordered, candidates[child].ordered))
      ++child;
    const uint other = candidates[child].ordered;
    if (!ox_is_ordered_before(candidates, other, sifted)) break;
    candidates[root].ordered = other;
    root = child;
  }
  candidates[root].ordered = sifted;
}

static inline void ox_make_heap(const ox_patches* p) {
  for (uint root = p->left / 2u; root-- > 0u;) ox_sift_down(p, root);
}

// The deepest that is left, which is no longer.
static inline uint ox_pop_deepest(ox_patches* p) {
  const uint deepest = p->candidates[0].ordered;
  p->candidates[0].ordered = p->candidates[--p->left].ordered;
  ox_sift_down(p, 0u);
  return deepest;
}

// All candidates of the kind, in no patch.
static inline void ox_begin_patches(ox_patches* p, __global ox_candidate* candidates, uint count,
                                    uint kind, float epsilon) {
  p->candidates = candidates;
  p->left = 0u;
  for (uint i = 0u; i < count; ++i)
    if (ox_kind(candidates + i) == kind) candidates[p->left++].ordered = i;
  p->patches = 0u;
  p->begin[0] = 0u;
  p->contradictor = OX_NONE;
  p->epsilon = epsilon;
  ox_make_heap(p);
}

// When all are in patches or dropped: the contacts chosen for regions are left once more.
static inline void ox_begin_regions(ox_patches* p, uint count) {
  p->left = 0u;
  for (uint i = 0u; i < count; ++i)
    if (p->candidates[i].patch < p->patches && p->candidates[i].region != OX_NONE)
      p->candidates[p->left++].ordered = i;
  ox_make_heap(p);
}

static inline float ox_distance2(__global const ox_candidate* a, __global const ox_candidate* b) {
  const float3 d = vload3(0, a->position) - vload3(0, b->position);
  return ox_dot(d, d);
}

// Four directions across a patch, 45 degrees apart: the first from its deepest to what is farthest
// from that. False: it has no others, or all lie behind one another.
static inline bool ox_directions_across(const ox_patches* p, uint begin, uint end, uint deepest,
                                        float3* directions) {
  __global const ox_candidate* candidates = p->candidates;
  const float3 normal = vload3(0, candidates[deepest].normal);
  uint far = deepest;
  float far2 = 0.0f;
  for (uint k = begin; k < end; ++k) {
    const uint i = candidates[k].listed;
    const float distance2 = ox_distance2(candidates + i, candidates + deepest);
    if (distance2 < far2 || (distance2 == far2 && !ox_is_keyed_before(candidates, i, far)))
      continue;
    far = i;
    far2 = distance2;
  }
  const float3 d = vload3(0, candidates[far].position) - vload3(0, candidates[deepest].position);
  const float3 across = d - ox_dot(d, normal) * normal;
  const float width2 = ox_dot(across, across);
  if (!(width2 > 0.0f)) return false;
  const float3 u = across / sqrt(width2);
  const float3 v = ox_plain_cross(normal, u);
  directions[0] = u;
  directions[1] = 0.70710678f * u + 0.70710678f * v;
  directions[2] = v;
  directions[3] = -0.70710678f * u + 0.70710678f * v;
  return true;
}

// Makes contenders of the outline of a patch, seen along its normal: of what is farthest in each of
// eight directions. A point within bears nothing that these do not, and costs the solver as much.
static inline uint ox_find_outline(const ox_patches* p, uint begin, uint end, uint deepest) {
  __global const ox_candidate* candidates = p->candidates;
  float3 directions[4];
  if (!ox_directions_across(p, begin, end, deepest, directions)) return 0u;
  uint best[8];  // along each direction, and against it
  float farthest[8];
  for (uint k = 0u; k < 8u; ++k) {
    best[k] = OX_NONE;
    farthest[k] = -INFINITY;
  }
  for (uint k = begin; k < end; ++k) {
    const uint i = candidates[k].listed;
    const float3 position = vload3(0, candidates[i].position);
    for (uint j = 0u; j < 8u; ++j) {
      const float along = ox_dot(position, directions[j >> 1]);
      const float reach = (j & 1u) != 0u ? -along : along;
      if (best[j] != OX_NONE && !(reach > farthest[j]) &&
          !(reach == farthest[j] && ox_is_keyed_before(candidates, i, best[j])))
        continue;
      best[j] = i;
      farthest[j] = reach;
    }
  }
  uint contenders = 0u;
  for (uint k = begin; k < end; ++k) {
    const uint i = candidates[k].listed;
    bool contends = false;
    for (uint j = 0u; j < 8u; ++j) contends = contends || best[j] == i;
    if (!contends) continue;
    const uint place = begin + contenders++;
    p->candidates[k].listed = candidates[place].listed;
    p->candidates[place].listed = i;
  }
  return contenders;
}

// Takes a candidate: the contenders of its patch learn how far they are from it.
static inline void ox_take(const ox_patches* p, uint taken, uint patch) {
  for (uint k = 0u; k < p->contenders[patch]; ++k) {
    __global ox_candidate* c = p->candidates + p->candidates[p->begin[patch] + k].listed;
    c->distance2 = ox_min(c->distance2, ox_distance2(c, p->candidates + taken));
  }
  p->candidates[taken].patch = OX_TAKEN;
}

// A new patch: `deepest`, which is taken, and all that are left and face its way. outline: only
// those on it may become contacts.
static inline void ox_open_patch(ox_patches* p, uint deepest, bool outline) {
  __global ox_candidate* candidates = p->candidates;
  const float3 normal = vload3(0, candidates[deepest].normal);
  const uint patch = p->patches++;
  const uint begin = p->begin[patch];
  uint end = begin;
  candidates[deepest].patch = patch;
  candidates[end++].listed = deepest;
  uint left = 0u;
  for (uint k = 0u; k < p->left; ++k) {
    const uint i = candidates[k].ordered;
    if (ox_dot(vload3(0, candidates[i].normal), normal) > 0.9f) {
      candidates[i].patch = patch;
      candidates[end++].listed = i;
    } else {
      candidates[left++].ordered = i;
    }
  }
  p->left = left;
  ox_make_heap(p);
  p->deepest[patch] = deepest;
  p->found[patch] = 0u;
  p->begin[patch + 1u] = end;
  p->contenders[patch] = outline ? ox_find_outline(p, begin, end, deepest) : end - begin;
  ox_take(p, deepest, patch);
}

// The contender that is farthest from what its patch has, and its patch; OX_NONE: there is none.
static inline uint ox_farthest(const ox_patches* p, uint* patch) {
  __global const ox_candidate* candidates = p->candidates;
  uint best = OX_NONE;
  for (uint g = 0u; g < p->patches; ++g)
    for (uint k = 0u; k < p->contenders[g]; ++k) {
      const uint i = candidates[p->begin[g] + k].listed;
      if (candidates[i].patch != g) continue;  // taken, or dropped
      if (best != OX_NONE && (candidates[i].distance2 != candidates[best].distance2
                                  ? candidates[i].distance2 < candidates[best].distance2
                                  : !ox_is_ordered_before(candidates, i, best)))
        continue;
      best = i;
      *patch = g;
    }
  return best;
}

static inline bool ox_gives_way(const ox_patches* p, uint i, uint to) {
  __global const ox_candidate* c = p->candidates + i;
  __global const ox_candidate* d = p->candidates + to;
  return d->patch != OX_DROPPED &&
         ((c->side_kind & OX_HIT_STANDS) == 0u || (d->side_kind & OX_HIT_STANDS) != 0u) &&
         ox_contradicts(c, d, p->epsilon) && ox_is_ordered_before(p->candidates, i, to);
}

// What contradicts a candidate faces at least 120 degrees away from it, what is in a patch at most
// 25.8 from its deepest: of a patch whose deepest faces less than 94.1 away nothing does. This is
// the cosine of 94.0, for rounding.
#define OX_FACES_AWAY (-0.07f)

// The first patch from g on in which something may contradict what faces the way of `normal`.
static inline uint ox_next_away(const ox_patches* p, float3 normal, uint g) {
  for (; g < p->patches; ++g) {
    __global const ox_candidate* deepest = p->candidates + p->deepest[g];
    if (ox_dot(normal, vload3(0, deepest->normal)) <= OX_FACES_AWAY) break;
  }
  return g;
}

// Whether a shallower candidate that is not dropped contradicts this one. One that nothing
// contradicts is taken, and few are; what contradicts the others has to be found fast. It is what
// contradicted the last one, else by turns one that is in no patch (`left`: how many those are),
// about as deep (in thick parts: the first of a heap) or one of the shallowest (in thin ones: its
// last), and one of a patch, from where the last of that patch was found.
static inline bool ox_is_contradicted(ox_patches* p, uint i, uint left) {
  __global const ox_candidate* candidates = p->candidates;
  const uint last = p->contradictor;
  if (last != OX_NONE && ox_gives_way(p, i, last)) return true;
  const float3 normal = vload3(0, candidates[i].normal);
  uint k = 0u;
  uint patch = ox_next_away(p, normal, 0u);
  uint looked = 0u;  // at so many of the patch
  while (k < left || patch < p->patches) {
    if (k < left) {
      p->contradictor = candidates[(k & 1u) == 0u ? k / 2u : left - 1u - k / 2u].ordered;
      if (ox_gives_way(p, i, p->contradictor)) return true;
      ++k;
    }
    if (patch == p->patches) continue;
    const uint begin = p->begin[patch];
    const uint size = p->begin[patch + 1u] - begin;
    const uint at = p->found[patch] + looked;
    p->contradictor = candidates[begin + (at < size ? at : at - size)].listed;
    if (ox_gives_way(p, i, p->contradictor)) {
      p->found[patch] = at < size ? at : at - size;
      return true;
    }
    if (++looked < size) continue;
    patch = ox_next_away(p, normal, patch + 1u);
    looked = 0u;
  }
  p->contradictor = last;
  return false;
}

static inline bool ox_drop_contradicted(ox_patches* p, uint i, uint left) {
  if (!ox_is_contradicted(p, i, left)) return false;
  p->candidates[i].patch = OX_DROPPED;
  return true;
}

#endif
#endif
