// SPDX-License-Identifier: BSD-3-Clause
// What is known of one side of a pair while its vertices inside are flooded. Device only.
#ifndef ODE_EXT_KERNELS_LIB_FLOOD_STATE_H
#define ODE_EXT_KERNELS_LIB_FLOOD_STATE_H

#include "lib/flood_table.h"
#include "lib/scene.h"

typedef struct {
  const ox_scene* scene;
  __global const ox_pair* pair;
  uint pair_side;
  __global const ox_mesh* source;
  __global const ox_mesh* target;
  uint vertex_first;  // of the source
  ox_flood_table table;
  bool leaks;         // the flood got round the border of an open target
  bool told;          // a crossing tells of an end of its edge
  bool asks;          // it goes on from vertices of which none tells
  bool refuted;       // and got to one that is outside by a crossing
  bool lies;          // it goes to vertices alone that lie on an open target
  bool is_near_only;  // and to those alone that can reach it
  bool is_below;      // all of the source is just below a ground
  uint crossed;       // so many of the queue are of parts that have crossings
} ox_flood_state;

static inline bool ox_is_open(const ox_flood_state* s) {
  return (s->target->flags & OX_MESH_CLOSED) == 0u;
}

static inline uint ox_chunk_of(const ox_flood_state* s, uint vertex) {
  return s->source->chunk_first + (vertex - s->vertex_first) / OX_CHUNK_VERTICES;
}
static inline uint ox_bit_in_chunk(const ox_flood_state* s, uint vertex) {
  return 1u << (vertex - s->vertex_first) % OX_CHUNK_VERTICES;
}

static inline bool ox_is_looked_at(const ox_flood_state* s, uint vertex) {
  if (s->table.places == 0u) return false;
  const uint key = OX_KEY(ox_chunk_of(s, vertex), OX_KEY_CHUNK);
  const uint word = ox_find_key(s->scene, &s->table, key);
  return s->scene->flood_words[word] != 0u &&
         (s->scene->flood_words[word + 1u] & ox_bit_in_chunk(s, vertex)) != 0u;
}

// Bits of a vertex in the queue, whose index is below both: it is the first of those that hang
// together; all of its chunk are queued from it on, the first, and no edge at them crosses.
#define OX_QUEUE_BEGINS 0x80000000u
#define OX_QUEUE_CHUNK 0x40000000u
#define OX_QUEUE_VERTEX (~(OX_QUEUE_BEGINS | OX_QUEUE_CHUNK))

static inline uint ox_queued(const ox_flood_state* s, uint i) {
  return ox_queue(s->scene, &s->table)[i] & OX_QUEUE_VERTEX;
}

static inline bool ox_is_chunk_queued(const ox_flood_state* s, uint i) {
  return i < s->table.queued && (ox_queue(s->scene, &s->table)[i] & OX_QUEUE_CHUNK) != 0u;
}

#endif
