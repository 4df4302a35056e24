// SPDX-License-Identifier: BSD-3-Clause
// Whole step: all steps of a pair one after the other, by one work-item. On a processor a launch
// costs as much as a pair, and what one kernel writes of a thousand pairs has left the cache when
// the next reads it. Each work-item has a share of the lists, which the pairs that it takes fill
// one after the other; the steps are those of the kernels, so this gives the same bytes.
//
// in, out: of the kernels whose steps these are
//       pairs: near only where a pair does not fit into a share: the kernels collide those
// item  1 pair (of a queue)
// may overflow: OX_LIST_CONTACTS; all others without loss
//
// It is left out where it never runs: on a GPU there is more to gain from many work-items than
// from a cache (OX_WHOLE_STEP, collide/collider_start.cpp).
#ifdef OX_WHOLE_STEP
#ifndef OX_WHOLE_PROGRAM
#include "contacts/choose.cl"
#include "contacts/features.cl"
#include "contacts/reduce.cl"
#include "cross.cl"
#include "cull.cl"
#include "flood.cl"
#include "match.cl"
#include "pair_step.cl"
#include "ray_step.cl"
#include "vertex_step.cl"
#endif

static void ox_clear_counters(const ox_scene* scene) {
  for (uint i = 0u; i < OX_COUNTER_COUNT; ++i) scene->counters[i * OX_COUNTER_STRIDE] = 0u;
}

// What all pairs of a work-item have counted: cores that add to one counter wait for one another,
// so they do it once.
typedef struct {
  uint of[OX_COUNTER_COUNT];
} ox_sums;

static void ox_add_counters(const ox_scene* scene, ox_sums* sums) {
  for (uint i = 0u; i < OX_COUNTER_COUNT; ++i)
    sums->of[i] += scene->counters[i * OX_COUNTER_STRIDE];
}

static void ox_add_sums(const ox_sums* sums, __global volatile uint* totals) {
  for (uint i = 0u; i < OX_COUNTER_COUNT; ++i)
    if (sums->of[i] != 0u) atomic_add(totals + i * OX_COUNTER_STRIDE, sums->of[i]);
}

static bool ox_fits(const ox_scene* scene, uint list) {
  return scene->counters[list * OX_COUNTER_STRIDE] <= scene->lists[list].capacity;
}

// The features of a pair; false: they do not fit into a share.
static bool ox_find_features(const ox_scene* scene) {
  ox_cull(scene);
  if (!ox_fits(scene, OX_LIST_MESHLETS)) return false;
  ox_match(scene);
  ox_cross_pairs(scene);
  if (!ox_fits(scene, OX_LIST_MESHLET_PAIRS) || !ox_fits(scene, OX_LIST_CROSSINGS)) return false;
  ox_flood_sides(scene);
  ox_choose_vertices(scene);
  if (!ox_fits(scene, OX_LIST_FLOOD_WORDS) || !ox_fits(scene, OX_LIST_CHUNKS) ||
      !ox_fits(scene, OX_LIST_RAYS))
    return false;
  ox_cast_rays(scene);
  return ox_fits(scene, OX_LIST_HITS);
}

static void ox_assemble_features(const ox_scene* scene) {
  ox_gather_features(scene);
  ox_place_features(scene);
  ox_link_features(scene);
  ox_join_features(scene);
  ox_begin_regions(scene);
  ox_count_members(scene);
  ox_place_regions(scene);
  ox_fill_regions(scene);
  ox_propose_planes(scene);
  ox_choose_planes(scene);
  ox_reduce_candidates(scene);
}

// Of the lists the part that is one work-item's: what of each pair it appends, and what becomes of
// that. The next pair takes the place of the last, so it is all in the cache of a core. Contacts
// are all work-items'.
static void ox_take_share(ox_scene* scene) {
  const uint item = scene->item;
  scene->counters += (OX_COUNTERS_SHARES + item) * OX_COUNTER_WORDS;
  scene->lists += OX_LIST_COUNT;
  scene->item = 0u;
  scene->item_count = 1u;
  scene->alone = true;
  __global const ox_list* each = scene->lists;
  scene->meshlet_tasks += item * each[OX_LIST_MESHLETS].capacity;
  scene->meshlet_pairs += item * each[OX_LIST_MESHLET_PAIRS].capacity;
  scene->crossings += item * each[OX_LIST_CROSSINGS].capacity;
  scene->flood_words += item * each[OX_LIST_FLOOD_WORDS].capacity;
  scene->tasks += item * each[OX_LIST_CHUNKS].capacity;
  scene->rays += item * each[OX_LIST_RAYS].capacity;
  scene->hits += item * each[OX_LIST_HITS].capacity;
  const ulong first =
      item * ((ulong)each[OX_LIST_CROSSINGS].capacity + each[OX_LIST_HITS].capacity);
  scene->features += first;
  scene->parents += first;
  scene->slots += OX_SLOTS_PER_FEATURE * first;
  scene->regions += first;
  scene->members += OX_MEMBER_WORDS * first;
  scene->faces += OX_FACES_PER_FEATURE * first;
  scene->planes += OX_PLANES_PER_FEATURE * OX_PLANE_WORDS * first;
  scene->edge_planes += 2u * first;
  scene->candidates += OX_CANDIDATES_PER_FEATURE * OX_CANDIDATE_WORDS * first;
}

__kernel void whole_step(OX_SCENE_PARAMETERS) {
  ox_scene scene = OX_SCENE;
  ox_take_share(&scene);
  __global volatile uint* totals = counters + OX_COUNTERS_TOTALS * OX_COUNTER_WORDS;
  ox_sums sums;
  for (uint i = 0u; i < OX_COUNTER_COUNT; ++i) sums.of[i] = 0u;
  for (;;) {
    const uint p = atomic_inc(totals + OX_QUEUE_PAIRS * OX_COUNTER_STRIDE);
    if (p >= pair_count) break;
    scene.pair_first = p;
    scene.pair_end = p + 1u;
    ox_clear_counters(&scene);
    ox_relate_pairs(&scene);
    if (pairs[p].near == 0u) continue;
    if (ox_find_features(&scene)) {
      ox_assemble_features(&scene);
      pairs[p].near = 0u;
    } else {
      ox_clear_counters(&scene);
      ox_count(&scene, OX_COUNTER_BOUNDED);
      ox_count(&scene, OX_COUNTER_LEFT);
    }
    ox_begin_found(found + p);
    ox_add_counters(&scene, &sums);
  }
  ox_add_sums(&sums, totals);
}

#endif
