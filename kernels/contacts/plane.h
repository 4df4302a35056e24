// SPDX-License-Identifier: BSD-3-Clause
// Separating planes: a face of either mesh, or the common normal of two edges. In the frame of B.
// Device only.
#ifndef ODE_EXT_KERNELS_CONTACTS_PLANE_H
#define ODE_EXT_KERNELS_CONTACTS_PLANE_H

#include "contacts/feature.h"
#include "lib/meshlet_tree.h"

// Kinds: a bit for each mesh that it clears, OX_PLANE_CLEARS.
#define OX_PLANE_NONE 0u
#define OX_PLANE_FACE_OF_A 1u
#define OX_PLANE_FACE_OF_B 2u
#define OX_PLANE_EDGES 3u
#define OX_PLANE_CLEARS(side) (2u >> (side))
#define OX_PLANE_KIND 3u
#define OX_PLANE_CROSSED 4u    // the curve in which the surfaces meet runs over the face
#define OX_PLANE_PASSED 8u     // part of its region is on the other side of it
#define OX_PLANE_MEASURED 16u  // OX_PLANE_OF_BODY is all of how deep that is

typedef struct {
  uint kind;       // OX_PLANE_...
  uint id[2];      // of a face: its triangle, 0; else the edges, of A and of B
  float3 normal;   // unit, the way A is moved
  float level[2];  // of A and B: to where it has to go the way it is moved [m]
  uint index;      // which of the planes of its region it is; OX_NONE: none of those
} ox_plane;

// The way that a plane with this normal moves mesh `side`.
static inline float3 ox_way_of(uint side, float3 normal) { return side == 0u ? normal : -normal; }

static inline ox_plane ox_no_plane(void) {
  ox_plane plane;
  plane.kind = OX_PLANE_NONE;
  plane.id[0] = plane.id[1] = OX_NONE;
  plane.normal = (float3)(0.0f);
  plane.level[0] = plane.level[1] = 0.0f;
  plane.index = OX_NONE;
  return plane;
}

static inline bool ox_is_same_plane(const ox_plane* a, const ox_plane* b) {
  return a->kind == b->kind && a->id[0] == b->id[0] && a->id[1] == b->id[1];
}

static inline float3 ox_corner(__global const ox_triangle* t, uint k) {
  return vload3(0, k == 0u ? t->a : k == 1u ? t->b : t->c);
}

// The plane at a triangle. Its normal is that of the largest triangle of the facet, the truest; its
// height is the triangle's own: a facet may be much larger than the region, and not quite flat.
static inline ox_plane ox_plane_of_face(const ox_scene* scene, uint pair, uint side,
                                        uint triangle) {
  const uint mesh = scene->pairs[pair].mesh[side];
  const float3 normal = ox_normal_of(
      scene, pair, side, scene->meshes[mesh].triangle_first + ox_facet_of(scene, triangle));
  ox_plane plane;
  plane.kind = side == 0u ? OX_PLANE_FACE_OF_A : OX_PLANE_FACE_OF_B;
  plane.id[0] = triangle;
  plane.id[1] = 0u;
  plane.index = OX_NONE;
  plane.normal = ox_way_of(side, -normal);
  // The highest of its corners, whichever comes first.
  __global const ox_triangle* t = scene->surfaces.triangles + triangle;
  float height = -INFINITY;
  for (uint k = 0u; k < 3u; ++k)
    height = ox_max(height, ox_dot(normal, ox_in_b(scene, pair, side, ox_corner(t, k))));
  plane.level[side] = -height;
  plane.level[1u - side] = height;
  if (ox_dot(normal, normal) == 0.0f) plane.kind = OX_PLANE_NONE;  // of no area
  return plane;
}

// Whether points of mesh `side` are below it, or above: whether it clears them.
static inline bool ox_clears_side(const ox_plane* plane, uint side) {
  return (plane->kind & OX_PLANE_CLEARS(side)) != 0u;
}

// How deep a point of mesh `side` is behind it [m].
static inline float ox_plane_depth(const ox_plane* plane, uint side, float3 p) {
  return plane->level[side] - ox_dot(ox_way_of(side, plane->normal), p);
}

// An edge between facets.
typedef struct {
  uint edge;
  float3 from, to;
  float3 along;   // unit; not finite where the edge has no length
  float3 normal;  // the sum of those of the faces
  uint face[2];   // the second is OX_NONE at a border
} ox_ridge;

static inline ox_ridge ox_ridge_of(const ox_scene* scene, uint pair, uint side, uint edge) {
  __global const ox_edge* e = scene->edges + edge;
  ox_ridge ridge;
  ridge.edge = edge;
  ridge.from = ox_vertex_of(scene, pair, side, e->vertex[0]);
  ridge.to = ox_vertex_of(scene, pair, side, e->vertex[1]);
  // Of unit length: products of four lengths overflow long before lengths do.
  const float3 d = ridge.to - ridge.from;
  ridge.along = d / sqrt(ox_dot(d, d));
  ridge.face[0] = e->triangle[0];
  ridge.face[1] = e->triangle[1];
  ridge.normal = ox_normal_of(scene, pair, side, ridge.face[0]);
  if (ridge.face[1] != OX_NONE) ridge.normal += ox_normal_of(scene, pair, side, ridge.face[1]);
  return ridge;
}

static inline uint ox_side_of_triangle(__global const ox_triangle* t, uint k) {
  return k == 0u ? t->side_ab : k == 1u ? t->side_bc : t->side_ca;
}

static inline bool ox_is_edge(uint at_side) { return (at_side & OX_WITHIN_FACET) == 0u; }

// What a face at an edge has to be behind, or else the edge does not support it.
typedef struct {
  uint pair, side;
  float3 normal;
  float height;  // [m] along it
} ox_support;

static inline bool ox_has_area(__global const ox_triangle* t) {
  return t->normal[0] != 0.0f || t->normal[1] != 0.0f || t->normal[2] != 0.0f;
}

static inline bool ox_is_behind_support(const ox_scene* scene, const ox_support* support,
                                        uint face) {
  __global const ox_triangle* t = scene->surfaces.triangles + face;
  for (uint corner = 0u; corner < 3u; ++corner) {
    const float3 p = ox_in_b(scene, support->pair, support->side, ox_corner(t, corner));
    if (ox_dot(support->normal, p) > support->height) return false;
  }
  return true;
}

// The same of what is across faces of no area, few of them, that begin at an edge, as lie between
// one long edge and several short ones.
static inline bool ox_is_all_behind(const ox_scene* scene, const ox_support* support, uint face) {
  uint faces[OX_FEW];
  faces[0] = face;
  uint count = 1u;
  for (uint i = 0u; i < count; ++i)
    for (uint k = 0u; k < 3u; ++k) {
      const uint at = ox_side_of_triangle(scene->surfaces.triangles + faces[i], k);
      if (!ox_is_edge(at)) return false;
      __global const uint* of_edge = scene->edges[at].triangle;
      const uint across = of_edge[0] == faces[i] ? of_edge[1] : of_edge[0];
      if (across == OX_NONE) continue;
      if (ox_has_area(scene->surfaces.triangles + across)) {
        if (!ox_is_behind_support(scene, support, across)) return false;
        continue;
      }
      uint known = 0u;
      while (known < count && faces[known] != across) ++known;
      if (known == OX_FEW) return false;
      if (known == count) faces[count++] = across;
    }
  return true;
}

// Whether the faces at an edge are behind a plane through it.
static inline bool ox_edge_supports(const ox_scene* scene, const ox_support* support,
                                    const ox_ridge* ridge) {
  for (uint k = 0u; k < 2u; ++k) {
    const uint face = ridge->face[k];
    if (face == OX_NONE) continue;
    if (ox_has_area(scene->surfaces.triangles + face) ? !ox_is_behind_support(scene, support, face)
                                                      : !ox_is_all_behind(scene, support, face))
      return false;
  }
  return true;
}

// Of an edge of A and one of B; OX_PLANE_NONE: they do not support it, or lie by more than `limit`
// one below the other [m].
static inline ox_plane ox_plane_of_ridges(const ox_scene* scene, uint pair, const ox_ridge* a,
                                          const ox_ridge* b, float limit) {
  ox_plane plane = ox_no_plane();
  const float3 n = ox_plain_cross(a->along, b->along);
  const float sine2 = ox_dot(n, n);
  if (!(sine2 > OX_PARALLEL * OX_PARALLEL)) return plane;  // or an edge has no length
  // Away from B, and towards A: at the rim of an open mesh one of the two alone may tell.
  const float3 outward = b->normal - a->normal;
  plane.normal = (ox_dot(n, outward) >= 0.0f ? n : -n) / sqrt(sine2);
  plane.level[0] = ox_dot(plane.normal, b->from);
  plane.level[1] = -ox_dot(plane.normal, a->from);
  const float depth = plane.level[0] + plane.level[1];
  if (depth < 0.0f || depth > limit) return plane;
  const float tolerance = OX_INFLATION * scene->pairs[pair].epsilon;
  const ox_support of_b = {pair, 1u, plane.normal, plane.level[0] + tolerance};
  const ox_support of_a = {pair, 0u, -plane.normal, plane.level[1] + tolerance};
  if (!ox_edge_supports(scene, &of_b, b) || !ox_edge_supports(scene, &of_a, a)) return plane;
  plane.kind = OX_PLANE_EDGES;
  plane.id[0] = a->edge;
  plane.id[1] = b->edge;
  return plane;
}

static inline ox_plane ox_plane_of_edges(const ox_scene* scene, uint pair, uint edge_a,
                                         uint edge_b) {
  const ox_ridge a = ox_ridge_of(scene, pair, 0u, edge_a);
  const ox_ridge b = ox_ridge_of(scene, pair, 1u, edge_b);
  return ox_plane_of_ridges(scene, pair, &a, &b, INFINITY);
}

// The farthest that mesh `side` reaches along a direction of the frame of B, from its base on [m];
// or something beyond `limit`.
static inline float ox_reach_along(const ox_scene* scene, uint pair, uint side, float3 direction,
                                   float limit) {
  __global const ox_mesh* mesh = scene->meshes + scene->pairs[pair].mesh[side];
  const float3 d = side == 0u ? ox_rotate(scene->pairs + pair, 1u, direction) : direction;
  const float3 base = ox_base(scene->pairs + pair, side);
  const float origin =
      side == 0u ? ox_dot(direction, vload3(0, scene->pairs[pair].base_offset[0])) : 0.0f;
  float farthest = -INFINITY;
  ox_box_walk walk = ox_begin_box_walk(mesh);
  while (walk.count != 0u && !(farthest + origin > limit)) {
    const uint child = walk.child[--walk.count];
    if ((child & OX_CHILD_MESHLET) != 0u) {
      __global const ox_meshlet* m = scene->surfaces.meshlets + mesh->meshlet_first + (child >> 1);
      for (uint block = 0u; block < OX_BLOCKS; ++block) {
        const ox_floats along = d.x * (ox_load(block, m->vertex[0]) - base.x) +
                                d.y * (ox_load(block, m->vertex[1]) - base.y) +
                                d.z * (ox_load(block, m->vertex[2]) - base.z);
        farthest = ox_max(farthest, ox_greatest_of(&along));
      }
      continue;
    }
    __global const ox_meshlet_node* node =
        scene->surfaces.nodes + mesh->meshlet_node_first + (child >> 1);
    ox_best_child best = {OX_NONE, 0.0f};
    for (uint block = 0u; block < OX_BLOCKS; ++block) {
      const ox_floats along =
          d.x * (ox_load(block, d.x > 0.0f ? node->hi[0] : node->lo[0]) - base.x) +
          d.y * (ox_load(block, d.y > 0.0f ? node->hi[1] : node->lo[1]) - base.y) +
          d.z * (ox_load(block, d.z > 0.0f ? node->hi[2] : node->lo[2]) - base.z);
      const ox_ints is_beyond = along > farthest;
      const uint beyond = ox_mask_of(&is_beyond) & ox_present_children(node, block);
      ox_push_children(node, block, beyond, &along, &walk, &best);
    }
    ox_put_best_last(&walk, &best);
  }
  return farthest + origin;
}

#endif
