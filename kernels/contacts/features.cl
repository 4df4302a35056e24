// SPDX-License-Identifier: BSD-3-Clause
// Features: what the surfaces of each pair have in common, and the regions they form. Two features
// are of one region that follow one another along the curve in which the surfaces meet, or along an
// edge inside the other mesh.
//
// in    crossings, hits: the vertices inside; pairs, and of meshes all but chunks and meshlets
// out   features; regions, their members and planes
// room  parents; slots, faces: tables (contacts/feature_table.h, contacts/face_table.h)
// item  1 feature (grid-stride); of feature_place 1 pair
// may overflow: none; all go by the number of crossings and hits
#include "contacts/chord.h"
#include "contacts/face_table.h"
#include "contacts/feature_table.h"
#include "contacts/mate.h"
#include "contacts/region_fields.h"

// out: features, each a tree of its own (parents); found: how many each pair has; tables, empty.
static void ox_gather_features(const ox_scene* scene) {
  const uint crossed = ox_crossing_count(scene);
  const uint count = ox_feature_count(scene);
  for (uint i = scene->item; i < count; i += scene->item_count) {
    ox_feature f;
    f.face = OX_NONE;
    f.next = OX_NONE;
    f.partner = OX_NONE;
    f.at[0] = f.at[1] = OX_NONE;
    f.mate[0] = f.mate[1] = OX_NONE;
    f.region = OX_NONE;
    float3 position;
    if (i < crossed) {
      const ox_edge_crossing crossing = scene->crossings[i];
      const uint side = crossing.pair_side & 1u;
      f.pair = crossing.pair_side >> 1;
      f.flags = side | (crossing.leaves != 0u ? OX_FEATURE_LEAVES : 0u);
      f.source = crossing.edge;
      f.triangle = crossing.triangle;
      f.t = crossing.t;
      f.at[0] = scene->edges[crossing.edge].triangle[0];
      f.at[1] = scene->edges[crossing.edge].triangle[1];
      if (ox_is_flat_edge(ox_mesh_of(scene, scene->pairs + f.pair, side), crossing.edge))
        f.flags |= OX_FEATURE_FLAT;
      f.mate[0] = i << 1;
      if (f.at[1] != OX_NONE) f.mate[1] = i << 1 | 1u;
      const float3 p = ox_vertex_of(scene, f.pair, side, scene->edges[crossing.edge].vertex[0]);
      const float3 d = ox_vertex_of(scene, f.pair, side, scene->edges[crossing.edge].vertex[1]) - p;
      const float length = sqrt(ox_dot(d, d));
      position = p + (length > 0.0f ? crossing.t / length : 0.0f) * d;
    } else {
      __global const ox_hit* hit = scene->hits + (i - crossed);
      const uint side = hit->pair_side & 1u;
      f.pair = hit->pair_side >> 1;
      const bool is_flat = ox_is_flat_vertex(scene, scene->pairs + f.pair, side, hit->vertex);
      f.flags = side | OX_FEATURE_VERTEX | (is_flat ? OX_FEATURE_FLAT : 0u) |
                ((hit->kind & OX_HIT_REVERSED) != 0u ? OX_FEATURE_REVERSED : 0u);
      f.source = hit->vertex;
      f.triangle = hit->triangle;
      f.t = 0.0f;
      f.next = hit->from;
      position = ox_vertex_of(scene, f.pair, side, hit->vertex);
      if (hit->edge != OX_NONE) {
        f.flags |= OX_FEATURE_MOVED;
        f.at[0] = scene->edges[hit->edge].triangle[0];
        __global const uint* ends = scene->edges[hit->edge].vertex;
        const uint other = ends[0] == hit->vertex ? ends[1] : ends[0];
        const float3 d = ox_vertex_of(scene, f.pair, side, other) - position;
        position += hit->t / sqrt(ox_dot(d, d)) * d;
      }
    }
    vstore3(position, 0, f.position);
    scene->features[i] = f;
    scene->parents[i] = i;
    for (uint k = OX_SLOTS_PER_FEATURE * i; k < OX_SLOTS_PER_FEATURE * (i + 1u); ++k)
      scene->slots[k] = OX_NONE;
    for (uint k = OX_FACES_PER_FEATURE * i; k < OX_FACES_PER_FEATURE * (i + 1u); ++k)
      scene->faces[k] = ox_no_face();
    ox_fetch_add(scene, &scene->found[f.pair].features, 1u);
  }
}

__kernel void feature_gather(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_gather_features(&scene);
}

// out: found, where the features of each pair are to start. item: 1 pair.
static void ox_place_features(const ox_scene* scene) {
  for (uint p = scene->pair_first + scene->item; p < scene->pair_end; p += scene->item_count)
    if (scene->found[p].features != 0u)
      scene->found[p].first = ox_take_room(scene, OX_COUNTER_FEATURES, scene->found[p].features);
}

__kernel void feature_place(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_place_features(&scene);
}

// The root of a tree of features. Others may hang trees on meanwhile; halves the way for the next.
static uint ox_root_of(const ox_scene* scene, uint i) {
  for (;;) {
    const uint parent = scene->parents[i];
    if (parent == i) return i;
    const uint above = scene->parents[parent];
    if (above != parent) ox_compare_exchange(scene, scene->parents + i, parent, above);
    i = above;
  }
}

// Trees hang on the lesser root: which that is in the end does not depend on the order.
static void ox_unite(const ox_scene* scene, uint a, uint b) {
  for (;;) {
    a = ox_root_of(scene, a);
    b = ox_root_of(scene, b);
    if (a == b) return;
    const uint above = min(a, b);
    const uint below = max(a, b);
    if (ox_compare_exchange(scene, scene->parents + below, below, above) == below) return;
  }
}

// out: slots; chains of the crossings of each edge, and of each pair of facets.
static void ox_link_features(const ox_scene* scene) {
  const uint count = ox_feature_count(scene);
  for (uint i = scene->item; i < count; i += scene->item_count) {
    __global ox_feature* f = scene->features + i;
    if (ox_is_vertex(f->flags)) {
      ox_add_feature(scene, i << 2 | OX_ENTRY_VERTEX);
      continue;
    }
    const uint of_edge = ox_add_feature(scene, i << 2 | OX_ENTRY_EDGE);
    if (of_edge == OX_NONE)
      f->region = i;  // for now: the chain begins with it
    else
      f->next = ox_exchange(scene, &scene->features[of_edge >> 2].next, i);
    for (uint k = 0u; k < 2u && (f->flags & OX_FEATURE_FLAT) == 0u; ++k) {
      if (f->at[k] == OX_NONE) continue;
      const uint other = ox_add_feature(scene, i << 2 | k);
      if (other == OX_NONE) continue;
      f->mate[k] = ox_exchange(scene, &scene->features[other >> 2].mate[other & 3u], i << 1 | k);
    }
  }
}

__kernel void feature_link(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_link_features(&scene);
}

// Where no flood told it: a vertex is united with those inside to which edges lead that do not
// cross.
static void ox_join_neighbours(const ox_scene* scene, uint i) {
  __global const ox_feature* f = scene->features + i;
  const uint side = ox_side_of(f->flags);
  for (uint k = scene->ring_starts[f->source]; k < scene->ring_starts[f->source + 1u]; ++k) {
    const ox_neighbour neighbour = scene->rings[k];
    if (neighbour.vertex < f->source) continue;  // it asks too
    if (ox_find_feature(scene, ox_edge_key(f->pair, side, neighbour.edge)) != OX_NONE) continue;
    const uint entry = ox_find_feature(scene, ox_inside_key(f->pair, side, neighbour.vertex));
    if (entry != OX_NONE) ox_unite(scene, i, entry >> 2);
  }
}

// A crossing is united with the other end of each stretch of the curve that it ends. Where that is
// not known it is united with any that has the pair of facets in common.
static void ox_join_stretches(const ox_scene* scene, uint i) {
  for (uint k = 0u; k < 2u; ++k) {
    const uint entry = i << 1 | k;
    const uint mate = scene->features[i].mate[k];
    if (mate == OX_NONE || mate == entry) continue;
    const uint end = ox_find_other_end(scene, entry);
    ox_unite(scene, i, (end == OX_NONE ? mate : end) >> 1);
  }
}

// A crossing of an edge with a vertex at its end, if that is inside.
static void ox_join_end(const ox_scene* scene, uint i, uint end) {
  __global const ox_feature* f = scene->features + i;
  const uint vertex = scene->edges[f->source].vertex[end];
  const uint entry = ox_find_feature(scene, ox_inside_key(f->pair, ox_side_of(f->flags), vertex));
  if (entry != OX_NONE) ox_unite(scene, i, entry >> 2);
}

// The crossings of an edge, from the head of their chain on, with the other ends of their chords.
// A sheet has no inside: what is beyond it may be at either end of an edge, whichever way the edge
// goes through it.
static void ox_join_chords(const ox_scene* scene, uint head) {
  const uint first = ox_find_partners(scene, head);
  uint last = first;
  for (uint n = first; n != OX_NONE; n = scene->features[n].next) {
    if (scene->features[n].partner != OX_NONE) ox_unite(scene, n, scene->features[n].partner);
    last = n;
  }
  ox_link_outside(scene->features, first);
  __global const ox_feature* f = scene->features + first;
  const uint target = scene->pairs[f->pair].mesh[1u - ox_side_of(f->flags)];
  if ((scene->meshes[target].flags & OX_MESH_TWO_SIDED) == 0u) return;
  ox_join_end(scene, first, 0u);
  ox_join_end(scene, last, 1u);
}

// An edge within a facet is followed from a vertex inside to where it leaves: with the stretch of
// the curve that runs over its facet there. Of the rim of a hole no other edge may leave what fills
// it.
static void ox_join_flat_edge(const ox_scene* scene, uint head) {
  for (uint n = ox_find_partners(scene, head); n != OX_NONE; n = scene->features[n].next) {
    const uint inside = scene->features[n].partner;
    if (inside == OX_NONE || !ox_is_vertex(scene->features[inside].flags)) continue;
    const uint end = ox_find_stretch_about(scene, n);
    if (end != OX_NONE) ox_unite(scene, inside, end);
  }
}

// out: partners, and what is next outside; which are nested; what follows one another along the
// curve or along an edge is united. Edges within facets that lead from no vertex inside need not be
// followed: what hangs together by them alone is within one facet.
static void ox_join_features(const ox_scene* scene) {
  const uint count = ox_feature_count(scene);
  for (uint i = scene->item; i < count; i += scene->item_count) {
    __global ox_feature* f = scene->features + i;
    if (!ox_is_vertex(f->flags)) {
      if ((f->flags & OX_FEATURE_FLAT) != 0u) {
        if (f->region == i) ox_join_flat_edge(scene, i);
        continue;
      }
      ox_join_stretches(scene, i);
      if (f->region == i) ox_join_chords(scene, i);
    } else if (f->next == OX_NONE) {
      ox_join_neighbours(scene, i);
    } else if (f->next != f->source) {
      const uint entry =
          ox_find_feature(scene, ox_inside_key(f->pair, ox_side_of(f->flags), f->next));
      if (entry != OX_NONE) ox_unite(scene, i, entry >> 2);
    }
  }
}

__kernel void feature_join(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_join_features(&scene);
}

// out: regions, without their members.
static void ox_begin_regions(const ox_scene* scene) {
  const uint count = ox_feature_count(scene);
  for (uint i = scene->item; i < count; i += scene->item_count) {
    if (scene->parents[i] != i) continue;
    const uint r = ox_take_room(scene, OX_COUNTER_REGIONS, 1u);
    scene->regions[r].pair = scene->features[i].pair;
    scene->regions[r].count = 0u;
    scene->regions[r].placed = 0u;
    scene->regions[r].flags = 0u;
    scene->regions[r].planes = 0u;
    scene->features[i].region = r;
  }
}

__kernel void region_begin(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_begin_regions(&scene);
}

// Whether its mesh is not convex at an edge of a feature.
static bool ox_is_in_valley(const ox_scene* scene, __global const ox_feature* f) {
  if (!ox_is_vertex(f->flags)) return ox_is_valley(scene, f->pair, f->source);
  __global const ox_mesh* mesh = ox_mesh_of(scene, scene->pairs + f->pair, ox_side_of(f->flags));
  for (uint k = scene->ring_starts[f->source]; k < scene->ring_starts[f->source + 1u]; ++k) {
    const uint edge = scene->rings[k].edge;
    if (!ox_is_flat_edge(mesh, edge) && ox_is_valley(scene, f->pair, edge)) return true;
  }
  return false;
}

// out: how many members each region has, and what they say of it. One valley is enough.
static void ox_count_members(const ox_scene* scene) {
  const uint count = ox_feature_count(scene);
  for (uint i = scene->item; i < count; i += scene->item_count) {
    const uint flags = scene->features[i].flags;
    if ((flags & OX_FEATURE_FLAT) != 0u) continue;
    const uint region = scene->features[ox_root_of(scene, i)].region;
    scene->features[i].region = region;
    ox_fetch_add(scene, &scene->regions[region].count, 1u);
    const uint known = scene->regions[region].flags;
    uint says = OX_REGION_OF(ox_side_of(flags)) | (ox_is_vertex(flags) ? 0u : OX_REGION_CROSSED);
    if ((known & OX_REGION_VALLEY) == 0u && ox_is_in_valley(scene, scene->features + i))
      says |= OX_REGION_VALLEY;
    if ((known & says) != says) ox_fetch_or(scene, &scene->regions[region].flags, says);
  }
}

__kernel void region_count(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_count_members(&scene);
}

// out: where the members of each region start, among those of its pair. item: 1 region.
static void ox_place_regions(const ox_scene* scene) {
  const uint count = scene->counters[OX_COUNTER_REGIONS * OX_COUNTER_STRIDE];
  for (uint r = scene->item; r < count; r += scene->item_count) {
    __global ox_found* of_pair = scene->found + scene->regions[r].pair;
    scene->regions[r].first =
        of_pair->first + ox_fetch_add(scene, &of_pair->placed, scene->regions[r].count);
  }
}

__kernel void region_place(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_place_regions(&scene);
}

// out: members of each region, in any order; the table of faces that are planes for it, and where
// in it the faces are that features are of.
static void ox_fill_regions(const ox_scene* scene) {
  const uint count = ox_feature_count(scene);
  for (uint i = scene->item; i < count; i += scene->item_count) {
    __global ox_feature* f = scene->features + i;
    if ((f->flags & OX_FEATURE_FLAT) != 0u) continue;
    __global ox_region* region = scene->regions + f->region;
    const uint side = ox_side_of(f->flags);
    const uint partner = f->partner;
    // A chord between two crossings begins where it enters.
    const bool begins = ox_is_vertex(f->flags) || (f->flags & OX_FEATURE_LEAVES) == 0u ||
                        partner == OX_NONE || ox_is_vertex(scene->features[partner].flags);
    float3 end = vload3(0, partner == OX_NONE ? f->position : scene->features[partner].position);
    __global const ox_mesh* target = scene->meshes + scene->pairs[f->pair].mesh[1u - side];
    // Inside a closed mesh; behind an open one it is not known how far.
    if (partner == OX_NONE && !ox_is_vertex(f->flags) && (target->flags & OX_MESH_CLOSED) != 0u)
      end = ox_vertex_of(
          scene, f->pair, side,
          scene->edges[f->source].vertex[(f->flags & OX_FEATURE_LEAVES) != 0u ? 0 : 1]);
    const ox_fields list = ox_members_of(scene, region);
    const uint place = ox_fetch_add(scene, &region->placed, 1u);
    ox_set_vector(&list, OX_MEMBER_POSITION, place, vload3(0, f->position));
    ox_set_vector(&list, OX_MEMBER_END, place, end);
    ox_words_of(&list, OX_MEMBER_FLAGS)[place] = f->flags | (begins ? OX_MEMBER_BEGINS : 0u);
    ox_words_of(&list, OX_MEMBER_FEATURE)[place] = i;
    const bool crossed = !ox_is_vertex(f->flags);
    const uint owner = f->region << 1 | (crossed ? 1u : 0u);
    if (f->triangle != OX_NONE) f->face = ox_add_face(scene, region, owner, 1u - side, f->triangle);
    for (uint k = 0u; k < 2u && crossed; ++k)
      if (f->at[k] != OX_NONE) ox_add_face(scene, region, owner, side, f->at[k]);
  }
}

__kernel void region_fill(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_fill_regions(&scene);
}

// Puts a plane among those of a region, and says where; OX_NONE: it is none.
static uint ox_add_plane(const ox_scene* scene, __global ox_region* region, const ox_plane* plane,
                         uint flags) {
  if (plane->kind == OX_PLANE_NONE) return OX_NONE;
  const ox_fields list = ox_planes_of(scene, region);
  const uint place = ox_fetch_add(scene, &region->planes, 1u);
  ox_store_plane(&list, place, plane, flags);
  return place;
}

// in: faces; features. out: planes of each region, in any order; of each crossing those of its
// edge, one for each facet at it. item: 1 place in the table of faces; 1 feature.
static void ox_propose_planes(const ox_scene* scene) {
  const uint count = ox_feature_count(scene);
  for (uint i = scene->item; i < OX_FACES_PER_FEATURE * count; i += scene->item_count) {
    __global ox_face* face = scene->faces + i;
    if (face->key == OX_NONE) continue;
    __global ox_region* region = scene->regions + (face->owner >> 1);
    const uint side = face->key & 1u;
    if (!ox_parts_by_faces_of(scene, region->pair, region->flags, side)) continue;
    const ox_plane plane = ox_plane_of_face(scene, region->pair, side, face->triangle);
    face->plane =
        ox_add_plane(scene, region, &plane, (face->owner & 1u) != 0u ? OX_PLANE_CROSSED : 0u);
  }
  for (uint i = scene->item; i < count; i += scene->item_count) {
    __global const ox_feature* f = scene->features + i;
    if ((f->flags & (OX_FEATURE_VERTEX | OX_FEATURE_FLAT)) != 0u) continue;
    for (uint k = 0u; k < 2u; ++k) {
      const uint mate = ox_mate_of(scene, i << 1 | k);
      if (mate == OX_NONE) {
        scene->edge_planes[2u * i + k] = OX_NONE;
      } else if (ox_side_of(f->flags) == 0u) {  // of two mates that of A proposes
        const ox_plane plane =
            ox_plane_of_edges(scene, f->pair, f->source, scene->features[mate >> 1].source);
        scene->edge_planes[2u * i + k] = scene->edge_planes[mate] =
            ox_add_plane(scene, scene->regions + f->region, &plane, 0u);
      }
    }
  }
}

__kernel void region_propose(OX_SCENE_PARAMETERS) {
  const ox_scene scene = OX_SCENE;
  ox_propose_planes(&scene);
}
