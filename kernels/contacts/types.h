// SPDX-License-Identifier: BSD-3-Clause
// The records of the assembly of contacts by separating planes, of host and device.
#ifndef ODE_EXT_KERNELS_CONTACTS_TYPES_H
#define ODE_EXT_KERNELS_CONTACTS_TYPES_H

#include "shared/types.h"

// What the surfaces of a pair have in common: a crossing, where an edge of one
// goes through a triangle of the other; or a vertex of one that is inside the other. Crossings come
// first, in the order of their list, then vertices in that of theirs.
#define OX_FEATURE_SIDE 1u       // of mesh B
#define OX_FEATURE_LEAVES 2u     // of a crossing: the edge leaves the other mesh here
#define OX_FEATURE_VERTEX 4u     // no crossing
#define OX_FEATURE_FLAT 8u       // within a facet: joins others, and is of no contact
#define OX_FEATURE_REVERSED 32u  // of a vertex: it is behind the face whose normal is turned
#define OX_FEATURE_VALLEY 16u    // of an edge, or at one, at which its mesh is not convex

typedef struct {
  ox_f32 position[3];  // in the frame of B
  ox_u32 pair;
  ox_u32 flags;     // OX_FEATURE_...
  ox_u32 source;    // the edge, or the vertex
  ox_u32 triangle;  // that is crossed, or that the ray of the vertex leaves by; OX_NONE: none is
  ox_f32 t;         // [m] along the edge, from its first vertex
  ox_u32 parent;    // of the features of a region, in a tree; in the end its root
  ox_u32 next;      // another crossing of the edge; OX_NONE: there is none
  ox_u32 partner;   // of a crossing: the feature at the other end of its chord; OX_NONE: none
  ox_u32 at[2];     // the triangles at the edge; the second is OX_NONE at a border
  // Crossings of edges of the other mesh with which it shares a pair of triangles; later the planes
  // of those edges, among those of the region. OX_NONE: there is none.
  ox_u32 mate[2];
  ox_u32 region;  // of overlap, among all
} ox_feature;
OX_STATIC_ASSERT(sizeof(ox_feature) == 64, ox_feature_is_64_bytes);

// Features that hang together, along edges and along the curve in which the surfaces meet.
typedef struct {
  ox_u32 pair;
  ox_u32 first, count;  // of its members; of its planes the first is OX_PLANES_PER_FEATURE * first
  ox_u32 placed;        // of its members, so far
  ox_u32 planes;        // how many
  ox_u32 flags;         // OX_REGION_...
  ox_u32 padding[2];
} ox_region;
OX_STATIC_ASSERT(sizeof(ox_region) == 32, ox_region_is_32_bytes);

#define OX_REGION_CROSSED 1u  // it has crossings
#define OX_REGION_VALLEY 2u   // one of its features has a valley

// Of each of its ends the face of the other mesh, and two pairs of edges.
#define OX_UNIT_PLANES 6u

// A feature among those of its region; and, where the region is not whole, the unit it begins: a
// vertex, or a chord, the stretch of an edge that is inside.
typedef struct {
  ox_f32 position[3];  // in the frame of B
  ox_u32 feature;
  ox_f32 end[3];  // of the chord, the other one; of a vertex its position
  ox_u32 flags;   // OX_FEATURE_...
  ox_u32 state;   // OX_UNIT_...
  // Of a unit: the planes that its features propose, among those of the region, OX_NONE after the
  // last; and the depth below the best of them [m].
  ox_u32 own[OX_UNIT_PLANES];
  ox_f32 least;
} ox_member;
OX_STATIC_ASSERT(sizeof(ox_member) == 64, ox_member_is_64_bytes);

#define OX_UNIT_NONE 0u     // another feature begins it, or it is of no contact
#define OX_UNIT_WAITING 1u  // to be cleared
#define OX_UNIT_CLEARED 2u

// A place in the table of faces by region and facet.
typedef struct {
  ox_u32 entry;     // feature << 2 | which of its faces; OX_NONE: free
  ox_u32 triangle;  // the first of the facet
  ox_u32 crossed;   // whether the curve in which the surfaces meet runs over the facet
  ox_u32 plane;     // its plane, among those of the region; OX_NONE: it is of no area
} ox_face;
OX_STATIC_ASSERT(sizeof(ox_face) == 16, ox_face_is_16_bytes);

// A separating plane that a region may part by, in the frame of B: a face of either mesh, or the
// common normal of two edges.
typedef struct {
  ox_f32 normal[3];  // unit, the way A is moved
  ox_f32 top;        // [m] along it, to where what of A is below has to rise
  ox_f32 bottom;     // to where what of B is above has to sink; of a face the same
  ox_u32 kind;       // OX_PLANE_..., with OX_PLANE_CROSSED
  ox_u32 id[2];      // of a face: its triangle, 0; else the edges, of A and of B (ox_ridge)
  ox_f32 beyond;     // [m] what it takes beside the region (ox_depth_beyond); negative: not known
  ox_u32 padding[3];
} ox_plane_record;
OX_STATIC_ASSERT(sizeof(ox_plane_record) == 48, ox_plane_record_is_48_bytes);

// Places in the table of features for each of them: a crossing has an edge and, with another, two
// pairs of triangles. In that of faces: a crossing has three. And planes: those, and a pair of
// edges for two crossings that share a pair of triangles.
#define OX_SLOTS_PER_FEATURE 4u
#define OX_FACES_PER_FEATURE 4u
#define OX_PLANES_PER_FEATURE 4u

#endif
