// SPDX-License-Identifier: BSD-3-Clause
// Flood: which vertices of one mesh are inside the other? Of an edge that enters a solid more often
// than it leaves it the far end is inside, of one that leaves it more often the near end, and else
// both ends are on one side. So from the inner ends of the former, over the latter, all vertices
// inside are reached; of a part of the mesh without the former one ray tells where all of it is.
// The rays of these vertices are cast (ray_step.cl), with those of vertices that may lie on the
// surface, and they decide: an edge misjudged here to within rounding costs rays, no contact.
//
// in    pairs, meshes, crossings, the list of them of each side of a pair (heads, links), vertices,
//       edges, rings, components, triangles, meshlets, meshlet_nodes
// out   rays, of targets that are embedded (OX_MESH_EMBEDDED)
// room  words: a table for each side (shared/flood_table.h)
// item  1 side of a pair (of a queue)
// may overflow: OX_LIST_RAYS_BVH, OX_LIST_FLOOD_WORDS
#include "shared/flood_table.h"
#include "shared/full_ray.h"

typedef struct {
  __global volatile uint* counters;
  __global const ox_list* lists;
  __global const ox_pair* pair;
  uint pair_side;
  __global const ox_edge_crossing* crossings;
  __global const uint* links;
  __global const ox_vertex* vertices;
  __global const ox_edge* edges;
  __global const uint* ring_starts;
  __global const ox_neighbour* rings;
  ox_surfaces surfaces;
  __global ox_ray* rays;
  __global uint* words;
  ox_flood_table table;
} ox_flood_state;

static bool ox_has_key(const ox_flood_state* s, uint key) {
  return s->table.places != 0u && s->words[ox_find_key(s->words, &s->table, key)] != 0u;
}

// Of a key that is not there. False: there is no room.
static bool ox_add_key(ox_flood_state* s, uint key, uint value) {
  if (!ox_grow_table(s->counters, s->lists, s->words, &s->table)) return false;
  const uint word = ox_find_key(s->words, &s->table, key);
  s->words[word] = key;
  s->words[word + 1u] = value;
  ++s->table.used;
  return true;
}

// Gives a vertex its ray; `inside`: and those that are on its side theirs. False: there is no room.
static bool ox_flood_vertex(ox_flood_state* s, uint vertex, bool inside) {
  const uint key = OX_KEY(vertex, OX_KEY_VERTEX);
  if (ox_has_key(s, key)) return true;
  if (!ox_add_key(s, key, 0u)) return false;
  if (inside) ox_queue(s->words, &s->table)[s->table.queued++] = vertex;
  const float3 direction = vload3(0, s->vertices[vertex].direction);
  if (direction.x == 0.0f && direction.y == 0.0f && direction.z == 0.0f) return true;
  const uint slot = ox_append(s->counters, s->lists, OX_LIST_RAYS_BVH);
  if (slot == OX_NONE) return true;
  s->rays[slot].pair_side = s->pair_side;
  s->rays[slot].vertex = vertex;
  s->rays[slot].memory = OX_NONE;
  s->rays[slot].triangle = OX_NONE;
  return true;
}

// Counts a crossing of its edge: how often the edge enters more than it leaves.
static bool ox_count_crossing(ox_flood_state* s, __global const ox_edge_crossing* c) {
  const uint key = OX_KEY(c->edge, OX_KEY_EDGE);
  if (!ox_has_key(s, key) && !ox_add_key(s, key, OX_BALANCED)) return false;
  s->words[ox_find_key(s->words, &s->table, key) + 1u] += c->leaves != 0u ? -1u : 1u;
  return true;
}

// How often the edge enters more than it leaves, from OX_BALANCED on.
static uint ox_balance(const ox_flood_state* s, uint edge) {
  const uint word = ox_find_key(s->words, &s->table, OX_KEY(edge, OX_KEY_EDGE));
  return s->words[word] != 0u ? s->words[word + 1u] : OX_BALANCED;
}

// The end of the edge that is inside, if one alone is.
static bool ox_flood_end(ox_flood_state* s, uint edge) {
  const uint balance = ox_balance(s, edge);
  return balance == OX_BALANCED ||
         ox_flood_vertex(s, s->edges[edge].vertex[balance > OX_BALANCED ? 1u : 0u], true);
}

// On over edges whose ends are on one side.
static bool ox_flood_on(ox_flood_state* s, uint* next) {
  for (; *next < s->table.queued; ++*next) {
    const uint vertex = ox_queue(s->words, &s->table)[*next];
    for (uint i = s->ring_starts[vertex]; i < s->ring_starts[vertex + 1u]; ++i) {
      const ox_neighbour neighbour = s->rings[i];
      if (ox_balance(s, neighbour.edge) == OX_BALANCED &&
          !ox_flood_vertex(s, neighbour.vertex, true))
        return false;
    }
  }
  return true;
}

// Whether a vertex that is not near the surface is inside, by a ray of any direction.
static bool ox_is_vertex_inside(const ox_flood_state* s, uint vertex,
                                __global const ox_mesh* target) {
  const uint side = s->pair_side & 1u;
  const float3 p = ox_place(s->pair, side, vload3(0, s->vertices[vertex].position));
  const float3 d = fabs(p - vload3(0, target->box_centre));
  const float3 limit = vload3(0, target->box_half) + s->pair->epsilon;
  if (d.x > limit.x || d.y > limit.y || d.z > limit.z) return false;
  ox_query query;
  query.cast.origin = p;
  query.epsilon = s->pair->epsilon;
  uint work = 0u;
  return ox_is_inside(false, &query, target, &s->surfaces, &work);
}

// Neighbours on one side with a vertex near the surface: which side that is, no crossing tells.
static bool ox_flood_around(ox_flood_state* s, uint vertex, __global const ox_mesh* target,
                            uint* next) {
  for (uint i = s->ring_starts[vertex]; i < s->ring_starts[vertex + 1u]; ++i) {
    const ox_neighbour neighbour = s->rings[i];
    const uint outside = OX_KEY(neighbour.vertex, OX_KEY_OUTSIDE);
    if (ox_has_key(s, OX_KEY(neighbour.vertex, OX_KEY_VERTEX)) || ox_has_key(s, outside) ||
        ox_balance(s, neighbour.edge) != OX_BALANCED)
      continue;
    const bool inside = ox_is_vertex_inside(s, neighbour.vertex, target);
    if (inside ? !ox_flood_vertex(s, neighbour.vertex, true) || !ox_flood_on(s, next)
               : !ox_add_key(s, outside, 0u))
      return false;
  }
  return true;
}

// Parts that no crossing told of: wholly inside, or wholly outside.
static bool ox_flood_components(ox_flood_state* s, __global const ox_mesh* source,
                                __global const ox_mesh* target, __global const uint* components,
                                uint* next) {
  if (source->component_count == 1u && s->table.queued != 0u) return true;
  for (uint i = 0u; i < source->component_count; ++i) {
    const uint vertex = components[source->component_first + i];
    if (ox_has_key(s, OX_KEY(vertex, OX_KEY_VERTEX))) continue;
    if (!ox_is_vertex_inside(s, vertex, target)) continue;
    if (!ox_flood_vertex(s, vertex, true) || !ox_flood_on(s, next)) return false;
  }
  return true;
}

static void ox_flood(ox_flood_state* s, uint head, __global const ox_mesh* source,
                     __global const ox_mesh* target, __global const uint* components) {
  uint count = 0u;
  for (uint c = head; c != OX_NONE; c = s->links[c]) ++count;
  uint places = OX_LEAST_PLACES;
  while (places < 4u * count) places *= 2u;
  s->table.places = s->table.used = s->table.queued = 0u;
  if (count != 0u) {
    s->table = ox_empty_table(s->counters, s->lists, s->words, places);
    if (s->table.places == 0u) return;
  }
  // Those near the surface first: from them nothing is concluded.
  for (uint c = head; c != OX_NONE; c = s->links[c])
    if (s->crossings[c].edge == OX_NONE && !ox_flood_vertex(s, s->crossings[c].triangle, false))
      return;
  for (uint c = head; c != OX_NONE; c = s->links[c])
    if (s->crossings[c].edge != OX_NONE && !ox_count_crossing(s, s->crossings + c)) return;
  for (uint c = head; c != OX_NONE; c = s->links[c])
    if (s->crossings[c].edge != OX_NONE && !ox_flood_end(s, s->crossings[c].edge)) return;
  uint next = 0u;
  if (!ox_flood_on(s, &next)) return;
  for (uint c = head; c != OX_NONE; c = s->links[c])
    if (s->crossings[c].edge == OX_NONE &&
        !ox_flood_around(s, s->crossings[c].triangle, target, &next))
      return;
  ox_flood_components(s, source, target, components, &next);
}

__kernel void flood(__global volatile uint* counters, __global const ox_list* lists,
                    __global const ox_pair* pairs, __global const ox_mesh* meshes,
                    __global const uint* heads, __global const ox_edge_crossing* crossings,
                    __global const uint* links, __global const ox_vertex* vertices,
                    __global const ox_edge* edges, __global const uint* ring_starts,
                    __global const ox_neighbour* rings, __global const uint* components,
                    __global const ox_triangle* triangles, __global const ox_meshlet* meshlets,
                    __global const ox_meshlet_node* meshlet_nodes, uint pair_count,
                    __global ox_ray* rays, __global uint* words) {
  for (uint i = ox_next_item(counters, OX_QUEUE_FLOOD); i < 2u * pair_count;
       i = ox_next_item(counters, OX_QUEUE_FLOOD)) {
    __global const ox_pair* pair = pairs + (i >> 1);
    if (pair->near == 0u) continue;
    __global const ox_mesh* source = meshes + pair->mesh[i & 1u];
    __global const ox_mesh* target = meshes + pair->mesh[1u - (i & 1u)];
    if ((target->flags & OX_MESH_EMBEDDED) == 0u) continue;
    ox_flood_state state;
    state.counters = counters;
    state.lists = lists;
    state.pair = pair;
    state.pair_side = i;
    state.crossings = crossings;
    state.links = links;
    state.vertices = vertices;
    state.edges = edges;
    state.ring_starts = ring_starts;
    state.rings = rings;
    state.surfaces.triangles = triangles;
    state.surfaces.meshlets = meshlets;
    state.surfaces.nodes = meshlet_nodes;
    state.rays = rays;
    state.words = words;
    ox_flood(&state, heads[i], source, target, components);
  }
}
