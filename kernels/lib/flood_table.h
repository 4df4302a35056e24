// SPDX-License-Identifier: BSD-3-Clause
// What a flood knows of one side of a pair: a hash table with open addressing, and the queue of the
// vertices to go on from. Grows by moving, so that room goes by what is found. Device only.
//
// Segment of 2^k places: a key and a value each, then the queue, OX_QUEUE_ROOM words a place.
#ifndef ODE_EXT_KERNELS_LIB_FLOOD_TABLE_H
#define ODE_EXT_KERNELS_LIB_FLOOD_TABLE_H

#include "lib/append.h"

// What a key is of: the index of a chunk, a vertex or an edge. They are below 2^30: as many edges
// are those of 700 million triangles, and their meshlets one buffer of 45 GiB.
//
// Value: a bit for each vertex of the chunk that is looked at, and OX_CHUNK_CROSSED. A vertex gets
// its ray where it is still queued in the end.
#define OX_KEY_CHUNK 1u
// An edge at one of its vertices crosses. That the key is there says so: the chunk is not taken
// whole.
#define OX_CHUNK_CROSSED (1u << OX_CHUNK_VERTICES)
#define OX_KEY_OUTSIDE 2u  // outside by its nearest crossing; value: OX_OUTSIDE_... (flood.cl)
#define OX_KEY_EDGE 3u     // that crosses; value: one of its crossings
#define OX_KEY(index, kind) ((index) << 2 | (kind))

#define OX_LEAST_PLACES 16u
#define OX_QUEUE_ROOM 4u  // vertices a place

typedef struct {
  uint first;   // word of the segment
  uint places;  // a power of two; 0: there was no room
  uint used;
  uint queued;
} ox_flood_table;

// Room for `count` words, or OX_NONE: the counter says what is lacking. It stops at
// OX_MOST_COUNTED, whatever is asked for.
static inline uint ox_take_words(const ox_scene* scene, uint count) {
  __global volatile uint* counter = scene->counters + OX_LIST_FLOOD_WORDS * OX_COUNTER_STRIDE;
  uint first = ox_fetch(counter);
  for (;;) {
    const uint end = count < OX_MOST_COUNTED - first ? first + count : OX_MOST_COUNTED;
    const uint seen = ox_compare_exchange(scene, counter, first, end);
    if (seen == first) break;
    first = seen;
  }
  const ox_list list = scene->lists[OX_LIST_FLOOD_WORDS];
  return first < list.capacity && count <= list.capacity - first ? list.first + first : OX_NONE;
}

static inline ox_flood_table ox_empty_table(const ox_scene* scene, uint places) {
  ox_flood_table table;
  table.first = ox_take_words(scene, (2u + OX_QUEUE_ROOM) * places);
  table.places = table.first == OX_NONE ? 0u : places;
  table.used = 0u;
  table.queued = 0u;
  for (uint i = OX_ITEM; i < table.places; i += OX_ITEMS)
    scene->flood_words[table.first + 2u * i] = 0u;
  ox_settle();
  return table;
}

// The word of a key: where it is, or would be.
static inline uint ox_find_key(const ox_scene* scene, const ox_flood_table* table, uint key) {
  uint place = mul_hi(key * 0x9e3779b1u, table->places);  // multiplicative (Knuth)
  for (;; ++place) {
    const uint word = table->first + 2u * (place & (table->places - 1u));
    const uint there = scene->flood_words[word];  // others of a group may be adding the same
    if (there == key || there == 0u) return word;
  }
}

static inline __global uint* ox_queue(const ox_scene* scene, const ox_flood_table* table) {
  return scene->flood_words + table->first + 2u * table->places;
}

// Room for one key more, the table being at most half full, and for the vertices of a chunk in the
// queue. False: there is none.
static inline bool ox_grow_table(const ox_scene* scene, ox_flood_table* table) {
  if (2u * (table->used + 1u) <= table->places &&
      table->queued + OX_CHUNK_VERTICES <= OX_QUEUE_ROOM * table->places)
    return true;
  if (table->places == 0u) {
    *table = ox_empty_table(scene, OX_LEAST_PLACES);
    return table->places != 0u;
  }
  ox_flood_table larger = ox_empty_table(scene, 2u * table->places);
  if (larger.places == 0u) {
    // More than is needed now: the less often a batch is redone.
    ox_take_words(scene, 16u * min(table->places, OX_MOST_COUNTED / 16u));
    return false;
  }
  for (uint i = 0u; i < table->places; ++i) {
    const uint key = scene->flood_words[table->first + 2u * i];
    if (key == 0u) continue;
    const uint word = ox_find_key(scene, &larger, key);
    scene->flood_words[word] = key;
    scene->flood_words[word + 1u] = scene->flood_words[table->first + 2u * i + 1u];
  }
  for (uint i = OX_ITEM; i < table->queued; i += OX_ITEMS)
    ox_queue(scene, &larger)[i] = ox_queue(scene, table)[i];
  ox_settle();
  larger.used = table->used;
  larger.queued = table->queued;
  *table = larger;
  return true;
}

static inline bool ox_has_key(const ox_scene* scene, const ox_flood_table* table, uint key) {
  return table->places != 0u && scene->flood_words[ox_find_key(scene, table, key)] != 0u;
}

// The word of a key, which is added with a value where it is not there. OX_NONE: there is no room.
static inline uint ox_find_or_add_key(const ox_scene* scene, ox_flood_table* table, uint key,
                                      uint value) {
  const uint places = table->places;
  uint word = places != 0u ? ox_find_key(scene, table, key) : OX_NONE;
  if (word != OX_NONE && scene->flood_words[word] != 0u) return word;
  if (!ox_grow_table(scene, table)) return OX_NONE;
  if (table->places != places) word = ox_find_key(scene, table, key);
  ox_settle();
  scene->flood_words[word] = key;
  scene->flood_words[word + 1u] = value;
  ox_settle();
  ++table->used;
  return word;
}

#endif
