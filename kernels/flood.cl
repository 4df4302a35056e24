// SPDX-License-Identifier: BSD-3-Clause
// Flood: which vertices of one mesh are inside the other? The crossing nearest to an end of an edge
// tells on which side of the surface that end is, and both ends of an edge without crossings are on
// one side. So from the former ends that are inside, over the latter edges, all vertices inside are
// reached, those of a chunk that hangs together and has no crossing edge all at once; of a part of
// the mesh without crossings one of its vertices is asked. An open target has no inside, but its
// faces have a space behind them. A part without crossings is not there, but where it lies on a
// face; and where the flood gets round the border, to an end in front, all vertices are looked at
// (vertex_step.cl). Crossings are those of meshes in general position: none only touches. Of these
// vertices rays are cast (ray_step.cl), for the face that each leaves by; but of those inside a
// closed target that lie within a facet none: they bound nothing.
//
// in    pairs, meshes, chunks, crossings, the list of them of each side of a pair (found),
//       vertices, edges, rings, triangles, meshlets, meshlet_nodes
// out   rays, of the sides that are flooded (lib/flooded.h)
//       tasks: of all others, and of those where the flood got round a border
//       crossings: `of_edge`, which strings those of an edge together
//       found: on which side of a sheet another mesh is; which mesh is just below its ground
// room  flood_words: a table for each side (lib/flood_table.h)
// item  1 side of a pair (of a queue); of a work-group, where lanes are one (lib/group.h)
// may overflow: OX_LIST_RAYS, OX_LIST_CHUNKS, OX_LIST_FLOOD_WORDS
#include "lib/below_ground.h"
#include "lib/closest.h"
#include "lib/crossed_edges.h"
#include "lib/flood_rays.h"
#include "lib/flooded.h"
#include "lib/general_position.h"
#include "lib/sheet_side.h"

// Whether a vertex lies on the surface of a target that is larger in general position. Rays of
// vertices start as far out of their own mesh.
static bool ox_lies_on(const ox_flood_state* s, uint index) {
  const uint side = s->pair_side & 1u;
  const float3 p = ox_place(s->pair, side, vload3(0, s->scene->vertices[index].position));
  return side != 0u && ox_closest_triangle(&s->scene->surfaces, s->target, ox_base(s->pair, 0u), p,
                                           OX_INFLATION * s->pair->epsilon, 0.0f) != OX_NONE;
}

static void ox_queue_chunk(ox_flood_state* s, __global const ox_chunk* chunk, uint begins) {
  __global uint* queue = ox_queue(s->scene, &s->table) + s->table.queued;
  for (uint i = OX_ITEM; i < chunk->count; i += OX_ITEMS)
    queue[i] = chunk->first + i | (i == 0u ? begins | OX_QUEUE_CHUNK : 0u);
  s->table.queued += chunk->count;
  ox_settle();
}

// Queues a vertex, or its chunk. `begins`: OX_QUEUE_BEGINS or 0. False: there is no room, or it is
// known to be in front.
static bool ox_flood_vertex(ox_flood_state* s, uint vertex, uint begins) {
  if (!ox_grow_table(s->scene, &s->table)) return false;
  __global const ox_chunk* chunk = s->scene->chunks + ox_chunk_of(s, vertex);
  const uint key = OX_KEY(ox_chunk_of(s, vertex), OX_KEY_CHUNK);
  const uint word = ox_find_key(s->scene, &s->table, key);
  const bool is_new = s->scene->flood_words[word] == 0u;
  const uint known = is_new ? 0u : s->scene->flood_words[word + 1u];
  if ((known & ox_bit_in_chunk(s, vertex)) != 0u) return true;
  // What a crossing tells of needs not lie on it to be known, and to get there is no leak.
  if (s->lies &&
      (ox_has_key(s->scene, &s->table, OX_KEY(vertex, OX_KEY_OUTSIDE)) || !ox_lies_on(s, vertex)))
    return true;
  if ((ox_is_open(s) || s->asks) &&
      ox_has_key(s->scene, &s->table, OX_KEY(vertex, OX_KEY_OUTSIDE))) {
    s->leaks = ox_is_open(s);
    s->refuted = s->asks;
    return false;
  }
  // Of an open source nothing but what can reach an open target gets a ray: a floor goes on beyond
  // the body on it, and all of that is behind the body's wall.
  const bool is_far =
      is_new && s->is_near_only && !ox_keep_chunk(s->pair, s->pair_side & 1u, s->target, chunk);
  const bool is_whole = is_far || (is_new && !s->lies && chunk->is_joined != 0u);
  ox_settle();
  s->scene->flood_words[word] = key;
  s->scene->flood_words[word + 1u] =
      is_whole ? (1u << chunk->count) - 1u : known | ox_bit_in_chunk(s, vertex);
  ox_settle();
  if (is_new) ++s->table.used;
  if (is_far) return true;
  if (is_whole)
    ox_queue_chunk(s, chunk, begins);
  else
    ox_queue(s->scene, &s->table)[s->table.queued++] = vertex | begins;
  return true;
}

// Every vertex of the source is the vertex step's.
static void ox_look_at_all(const ox_flood_state* s) {
  for (uint begin = 0u; begin < s->source->chunk_count; begin += OX_ITEMS) {
    const uint k = begin + OX_ITEM;
    const uint chunk = s->source->chunk_first + k;
    const bool keeps =
        k < s->source->chunk_count &&
        ox_keep_chunk(s->pair, s->pair_side & 1u, s->target, s->scene->chunks + chunk);
    const uint index = ox_append_each(s->scene, OX_LIST_CHUNKS, keeps);
    if (index == OX_NONE) continue;
    s->scene->tasks[index].pair_side = s->pair_side;
    s->scene->tasks[index].chunk = chunk;
  }
}

static bool ox_mark_chunk(ox_flood_state* s, uint vertex) {
  const uint key = OX_KEY(ox_chunk_of(s, vertex), OX_KEY_CHUNK);
  return ox_find_or_add_key(s->scene, &s->table, key, OX_CHUNK_CROSSED) != OX_NONE;
}

// Strings the crossings of an edge together, from the last to come on, before any vertex is looked
// at.
static bool ox_string_crossing(ox_flood_state* s, uint crossing) {
  __global ox_edge_crossing* c = s->scene->crossings + crossing;
  const uint key = OX_KEY(c->edge, OX_KEY_EDGE);
  const uint word = ox_find_or_add_key(s->scene, &s->table, key, OX_NONE);
  if (word == OX_NONE) return false;
  const uint last = s->scene->flood_words[word + 1u];
  ox_settle();
  c->of_edge = last;
  s->scene->flood_words[word + 1u] = crossing;
  ox_settle();
  if (last != OX_NONE) return true;
  __global const ox_edge* edge = s->scene->edges + c->edge;
  return ox_mark_chunk(s, edge->vertex[0]) && ox_mark_chunk(s, edge->vertex[1]);
}

static bool ox_is_parted(const ox_flood_state* s, uint edge) {
  return ox_side_of_end(s->scene, &s->table, s->pair->epsilon, edge, 0u) != OX_END_UNPARTED;
}

// Whether it is the crossing by which its edge is looked at, once for all of them.
static bool ox_is_for_edge(const ox_flood_state* s, uint crossing) {
  const uint edge = s->scene->crossings[crossing].edge;
  const uint word = ox_find_key(s->scene, &s->table, OX_KEY(edge, OX_KEY_EDGE));
  return s->scene->flood_words[word + 1u] == crossing;
}

#define OX_OUTSIDE_SO_FAR 0u  // of a target of several parts: behind the wall in front of it it may
#define OX_OUTSIDE_ASKED 1u   // be in another part, which it is asked for once

// The ends outside. In front of an open target: a flood that gets there got round its border. And
// of a mesh of several parts, of which some may have crossings and others none.
static bool ox_mark_ends(ox_flood_state* s, uint edge) {
  for (uint end = 0u; end < 2u; ++end) {
    const uint outside = OX_KEY(s->scene->edges[edge].vertex[end], OX_KEY_OUTSIDE);
    if (ox_side_of_end(s->scene, &s->table, s->pair->epsilon, edge, end) == OX_END_OUTSIDE &&
        ox_find_or_add_key(s->scene, &s->table, outside, OX_OUTSIDE_SO_FAR) == OX_NONE)
      return false;
  }
  return true;
}

static bool ox_flood_others(ox_flood_state* s, uint other, bool is_next) {
  for (uint left = ox_group_bits(is_next); left != 0u; left &= left - 1u)
    if (!ox_flood_vertex(s, ox_of_item(other, ox_lowest(left)), 0u)) return false;
  return true;
}

// On from a chunk, at which no edge crosses.
static bool ox_flood_from_chunk(ox_flood_state* s, __global const ox_chunk* chunk) {
  for (uint begin = 0u; begin < chunk->count; begin += OX_ITEMS) {
    const uint vertex = chunk->first + begin + OX_ITEM;
    const bool is_there = begin + OX_ITEM < chunk->count;
    const uint end = is_there ? s->scene->ring_starts[vertex + 1u] : 0u;
    uint k = is_there ? s->scene->ring_starts[vertex] : 0u;
    for (; ox_any_item(k < end); ++k) {
      const uint other = s->scene->rings[k < end ? k : 0u].vertex;
      const bool is_next =
          k < end && other - chunk->first >= chunk->count && !ox_is_looked_at(s, other);
      if (!ox_flood_others(s, other, is_next)) return false;
    }
  }
  return true;
}

// On from the next vertices of the queue over edges that do not cross: so many at once, since a
// vertex has about six neighbours.
#define OX_AT_ONCE (OX_ITEMS == 1u ? 1u : 2u)
static bool ox_flood_next(ox_flood_state* s, uint* next) {
  if (ox_is_chunk_queued(s, *next)) {
    __global const ox_chunk* chunk = s->scene->chunks + ox_chunk_of(s, ox_queued(s, *next));
    *next += chunk->count;
    return ox_flood_from_chunk(s, chunk);
  }
  const uint of_each = OX_ITEMS / OX_AT_ONCE;
  const uint queued = *next + OX_ITEM / of_each;
  *next = ox_is_chunk_queued(s, *next + 1u) ? *next + 1u : min(*next + OX_AT_ONCE, s->table.queued);
  const bool is_queued = queued < *next;
  const uint vertex = is_queued ? ox_queued(s, queued) : 0u;
  const uint end = is_queued ? s->scene->ring_starts[vertex + 1u] : 0u;
  uint k = is_queued ? s->scene->ring_starts[vertex] + OX_ITEM % of_each : 0u;
  for (; ox_any_item(k < end); k += of_each) {
    __global const ox_neighbour* neighbour = s->scene->rings + (k < end ? k : 0u);
    const uint other = neighbour->vertex;
    // Mostly it is looked at.
    const bool is_next = k < end && !ox_is_looked_at(s, other) && !ox_is_parted(s, neighbour->edge);
    if (!ox_flood_others(s, other, is_next)) return false;
  }
  return true;
}

static bool ox_flood_on(ox_flood_state* s, uint* next) {
  while (*next < s->table.queued)
    if (!ox_flood_next(s, next)) return false;
  return true;
}

// From a vertex to all that hang together with it, before another is begun with.
static bool ox_flood_from(ox_flood_state* s, uint vertex, uint* next) {
  return ox_flood_vertex(s, vertex, OX_QUEUE_BEGINS) && ox_flood_on(s, next);
}

static bool ox_flood_ends(ox_flood_state* s, uint edge, uint* next) {
  for (uint end = 0u; end < 2u; ++end) {
    const uint side = ox_side_of_end(s->scene, &s->table, s->pair->epsilon, edge, end);
    if (side != OX_END_UNPARTED) s->told = true;
    if (side == OX_END_INSIDE && !ox_flood_from(s, s->scene->edges[edge].vertex[end], next))
      return false;
  }
  return true;
}

// Whether a vertex is so near the surface that rounding may say on which side: no farther than what
// a plane clears may be above it, so that where all of a part are near, the face clears it.
static bool ox_is_near_surface(const ox_flood_state* s, uint vertex) {
  const uint side = s->pair_side & 1u;
  const float3 p = ox_place(s->pair, side, vload3(0, s->scene->vertices[vertex].position));
  const float near = OX_CLEARANCE * s->pair->epsilon;
  return ox_closest_triangle(&s->scene->surfaces, s->target, ox_base(s->pair, 1u - side), p, near,
                             0.0f) != OX_NONE;
}

// Whether a vertex that is not near the surface is inside of a closed target.
static bool ox_is_vertex_inside(const ox_flood_state* s, uint index) {
  const uint side = s->pair_side & 1u;
  __global const ox_vertex* vertex = s->scene->vertices + index;
  const float3 base = ox_base(s->pair, 1u - side);
  float3 p = ox_place(s->pair, side, vload3(0, vertex->position));
  // As in general position: where surfaces coincide, A is outside of B, and B inside of A.
  if (side == 0u)
    p -= OX_INFLATION * s->pair->epsilon * ox_rotate(s->pair, side, vload3(0, vertex->direction));
  return ox_winds_about(base, p, (float3)(0.0f), s->pair->epsilon, s->target,
                        &s->scene->surfaces) ||
         ox_lies_on(s, index);
}

// Of vertices that hang together without a crossing, so that they are all on one side, one of which
// no crossing tells: it is asked, and floods the others if it is inside. Where it lies so near the
// surface that rounding may have answered, the flood goes on to the first that does not, which
// tells; where all do, `is_near_inside`. False: there is no room.
static bool ox_flood_if_inside(ox_flood_state* s, uint vertex, bool is_near_inside, uint* next) {
  if (!ox_keep_vertex(s->pair, s->pair_side & 1u, s->scene->meshes, s->scene->vertices + vertex))
    return true;
  bool is_near = ox_is_near_surface(s, vertex);
  bool is_inside = ox_is_vertex_inside(s, vertex) && (!is_near || is_near_inside);
  if (!is_near && !is_inside) return true;
  const uint queued = s->table.queued;
  s->refuted = false;
  bool done = ox_flood_vertex(s, vertex, OX_QUEUE_BEGINS);
  for (uint asked = queued; done && is_near; ++asked) {
    while (done && asked == s->table.queued && *next < asked) done = ox_flood_next(s, next);
    if (!done || asked == s->table.queued) break;
    const uint other = ox_queued(s, asked);
    is_near = ox_is_near_surface(s, other);
    if (!is_near) is_inside = ox_is_vertex_inside(s, other);
  }
  if (done && is_inside) done = ox_flood_on(s, next);
  if (!done && !s->refuted) return false;
  if (s->refuted || !is_inside) s->table.queued = *next = queued;
  return true;
}

static bool ox_flood_other_ends(ox_flood_state* s, uint edge, uint* next) {
  for (uint end = 0u; end < 2u; ++end) {
    const uint vertex = s->scene->edges[edge].vertex[end];
    if (ox_side_of_end(s->scene, &s->table, s->pair->epsilon, edge, end) != OX_END_OUTSIDE ||
        ox_is_looked_at(s, vertex))
      continue;
    const uint word =
        ox_find_or_add_key(s->scene, &s->table, OX_KEY(vertex, OX_KEY_OUTSIDE), OX_OUTSIDE_SO_FAR);
    if (word == OX_NONE) return false;
    if (s->scene->flood_words[word + 1u] == OX_OUTSIDE_ASKED) continue;
    ox_settle();
    s->scene->flood_words[word + 1u] = OX_OUTSIDE_ASKED;
    ox_settle();
    // What is all on the surface of another part is no deeper in it than rounding.
    if (!ox_flood_if_inside(s, vertex, false, next)) return false;
  }
  return true;
}

static bool ox_flood_component(ox_flood_state* s, uint first, uint* next) {
  if (ox_is_looked_at(s, first)) return true;
  if (s->lies) return !ox_lies_on(s, first) || ox_flood_from(s, first, next);
  return ox_flood_if_inside(s, first, true, next);
}

// Of each part of the source its first vertex is asked.
static bool ox_flood_firsts(ox_flood_state* s, uint* next) {
  if (s->source->component_count == 1u)
    return ox_flood_component(s, s->scene->chunks[s->source->chunk_first].first, next);
  // What is inside of the target is in its box.
  const ox_box box = ox_target_box(s->pair, s->pair_side & 1u, s->target);
  ox_box_walk walk = ox_begin_box_walk(s->source);
  for (;;) {
    const uint m = ox_next_in_box(&walk, &box, s->source, s->scene->surfaces.nodes);
    if (m == OX_NONE) return true;
    __global const ox_meshlet* meshlet = s->scene->surfaces.meshlets + m;
    for (uint firsts = meshlet->firsts; firsts != 0u; firsts &= firsts - 1u)
      if (!ox_flood_component(s, meshlet->vertex_index[ox_lowest(firsts)], next)) return false;
  }
}

static bool ox_flood_all(ox_flood_state* s, uint* next) {
  for (uint k = 0u; k < s->source->chunk_count; ++k) {
    __global const ox_chunk* chunk = s->scene->chunks + s->source->chunk_first + k;
    for (uint v = chunk->first; v < chunk->first + chunk->count; ++v)
      if (!ox_is_looked_at(s, v) && !ox_flood_from(s, v, next)) return false;
  }
  return true;
}

// Parts of the source that no crossing told of. Behind an open target they are not, unless they lie
// on it, or it is a ground just above all of the body: what of it is inside of them is so with all
// of its vertices. Their faces may be crossed all the same.
static bool ox_flood_components(ox_flood_state* s, uint* next) {
  s->is_below = !s->told && ox_is_just_below_ground(s);
  if (s->is_below) return ox_flood_all(s, next);
  s->lies = ox_is_open(s);
  s->asks = !s->lies;
  return (s->told && s->source->component_count == 1u) || ox_flood_firsts(s, next);
}

// False: there is no room, or the flood leaks.
static bool ox_flood(ox_flood_state* s, uint head) {
  uint count = 0u;
  for (uint c = head; c != OX_NONE; c = s->scene->crossings[c].before) ++count;
  uint places = OX_LEAST_PLACES;
  while (places < 4u * count) places *= 2u;
  s->table.places = s->table.used = s->table.queued = 0u;
  if (count != 0u) {
    s->table = ox_empty_table(s->scene, places);
    if (s->table.places == 0u) return false;
  }
  uint next = s->table.queued;
  for (uint c = head; c != OX_NONE; c = s->scene->crossings[c].before)
    if (!ox_string_crossing(s, c)) return false;
  const bool marks = ox_is_open(s) || s->source->component_count > 1u;
  for (uint c = head; c != OX_NONE && marks; c = s->scene->crossings[c].before)
    if (ox_is_for_edge(s, c) && !ox_mark_ends(s, s->scene->crossings[c].edge)) return false;
  for (uint c = head; c != OX_NONE; c = s->scene->crossings[c].before)
    if (ox_is_for_edge(s, c) && !ox_flood_ends(s, s->scene->crossings[c].edge, &next)) return false;
  const bool many_parts = !ox_is_open(s) && s->target->component_count > 1u;
  for (uint c = head; c != OX_NONE && many_parts; c = s->scene->crossings[c].before)
    if (ox_is_for_edge(s, c) && !ox_flood_other_ends(s, s->scene->crossings[c].edge, &next))
      return false;
  s->crossed = s->table.queued;
  return ox_flood_components(s, &next);
}

static void ox_flood_sides(const ox_scene* scene) {
  const uint first = 2u * scene->pair_first;
  for (uint i = first + ox_next_item(scene, OX_QUEUE_FLOOD); i < 2u * scene->pair_end;
       i = first + ox_next_item(scene, OX_QUEUE_FLOOD)) {
    __global const ox_pair* pair = scene->pairs + (i >> 1);
    if (pair->near == 0u) continue;
    ox_flood_state state;
    state.scene = scene;
    state.pair = pair;
    state.pair_side = i;
    state.source = scene->meshes + pair->mesh[i & 1u];
    state.target = scene->meshes + pair->mesh[1u - (i & 1u)];
    state.vertex_first = scene->chunks[state.source->chunk_first].first;
    state.told = state.asks = state.refuted = state.lies = state.is_below = false;
    state.crossed = 0u;
    state.is_near_only = ((state.source->flags | state.target->flags) & OX_MESH_CLOSED) == 0u;
    state.leaks = !ox_is_flooded(scene, state.source, state.target);
    if ((i & 1u) == 1u - ox_sheet_of(scene, pair) && ox_is_first_item())
      scene->found[i >> 1].sheet_side = ox_find_sheet_side(scene, i >> 1, 1u - (i & 1u));
    if (!state.leaks) ox_flood(&state, scene->found[i >> 1].head[i & 1u]);
    if (state.is_below && ox_is_first_item()) scene->found[i >> 1].is_below[i & 1u] = 1u;
    if (state.leaks)
      ox_look_at_all(&state);
    else
      ox_cast_queue(&state);
  }
}

__kernel void flood(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_flood_sides(&scene);
}
