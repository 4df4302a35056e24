// SPDX-License-Identifier: BSD-3-Clause
// The records of the assembly of contacts by separating planes, of host and device.
#ifndef ODE_EXT_KERNELS_ABI_CONTACTS_H
#define ODE_EXT_KERNELS_ABI_CONTACTS_H

#include "abi/types.h"

// What the surfaces of a pair have in common: a crossing, where an edge of one
// goes through a triangle of the other; or a vertex of one that is inside the other. Crossings come
// first, in the order of their list, then vertices in that of theirs.
#define OX_FEATURE_SIDE 1u       // of mesh B
#define OX_FEATURE_LEAVES 2u     // of a crossing: the edge leaves the other mesh here
#define OX_FEATURE_VERTEX 4u     // no crossing
#define OX_FEATURE_FLAT 8u       // within a facet: of no contact, and no member of a region
#define OX_FEATURE_REVERSED 16u  // of a vertex: it is behind the face whose normal is turned
#define OX_FEATURE_NESTED 32u    // of a crossing: within a longer chord of the edge
#define OX_FEATURE_MOVED 2048u   // of a vertex: a place on an edge stands for it (ox_hit)

typedef struct ox_feature {
  ox_f32 position[3];  // in the frame of B
  ox_u32 pair;
  ox_u32 flags;     // OX_FEATURE_...
  ox_u32 source;    // the edge, or the vertex
  ox_u32 triangle;  // that is crossed, or that the ray of the vertex leaves by; OX_NONE: none is
  ox_f32 t;         // [m] along the edge, from its first vertex
  ox_u32 face;      // that is crossed, or left by, among those of the region (ox_face); or OX_NONE
  // Another crossing of the edge, and once chords are known that at the other end of the stretch
  // outside; of a vertex `from` of ox_hit; or OX_NONE.
  ox_u32 next;
  ox_u32 partner;  // of a crossing: the feature at the other end of its chord; OX_NONE: none
  // The triangles at the edge, the second OX_NONE at a border; of a vertex that is moved the first
  // is one at the edge that it is moved along.
  ox_u32 at[2];
  // Of a crossing, for each facet at its edge: the next that has the pair of facets in common, and
  // so on round about, feature << 1 | which of the facets at its edge; OX_NONE at a border.
  ox_u32 mate[2];
  ox_u32 region;  // of overlap, among all; until then itself, where the chain of its edge begins
} ox_feature;
OX_STATIC_ASSERT(sizeof(ox_feature) == 64, ox_feature_is_64_bytes);

// Features that hang together, along edges and along the curve in which the surfaces meet.
typedef struct ox_region {
  ox_u32 pair;
  ox_u32 first, count;  // of its members; of its planes the first is OX_PLANES_PER_FEATURE * first
  ox_u32 placed;        // of its members, so far
  ox_u32 planes;        // how many
  ox_u32 flags;         // OX_REGION_...
  ox_u32 padding[2];
} ox_region;
OX_STATIC_ASSERT(sizeof(ox_region) == 32, ox_region_is_32_bytes);

// OX_REGION_CROSSED: it has crossings
#define OX_REGION_VALLEY 2u                // one of its features has a valley
#define OX_REGION_OF(side) (4u << (side))  // one is of an edge or a vertex of that mesh

// The members of a region, features of it; where it is not whole some begin a unit: a vertex, or a
// chord, the stretch of an edge that is inside. Each field lies for itself (contacts/fields.h).
#define OX_MEMBER_POSITION 0u  // three, in the frame of B
#define OX_MEMBER_END 3u       // three: of the chord the other one; of a vertex its position
// Of a unit the best of the planes that it proposes: its normal, three; how deep below it the unit
// is [m]; which it is (contacts/units.h: ox_own_plane), OX_NONE if there is none.
#define OX_MEMBER_NORMAL 6u
#define OX_MEMBER_LEAST 9u
#define OX_MEMBER_FLAGS 10u    // OX_FEATURE_..., with OX_MEMBER_BEGINS
#define OX_MEMBER_FEATURE 11u  // among all
#define OX_MEMBER_PLANE 12u
#define OX_MEMBER_WORDS 13u

#define OX_MEMBER_BEGINS 64u    // it begins a unit
#define OX_MEMBER_NEAREST 128u  // a unit: the nearest face that it is behind has been asked for
#define OX_MEMBER_CLEARED 256u  // a unit: it waits for no plane any more
#define OX_MEMBER_LATER 512u    // a unit: only where of no other a plane is known
#define OX_MEMBER_FOUND 1024u   // a unit: it proposes the face that was found for it
#define OX_MEMBER_VALLEY 4096u  // a unit: of a valley, it comes after all others

// A place in the table of the faces of a region, one of each facet.
typedef struct ox_face {
  ox_u32 key;    // facet << 1 | mesh; OX_NONE: free
  ox_u32 owner;  // region, among all, << 1 | whether the curve of the surfaces runs over the facet
  ox_u32 triangle;  // the first of those of the facet that are at features of the region
  ox_u32 plane;     // its plane, among those of the region; OX_NONE: it is of no area
} ox_face;
OX_STATIC_ASSERT(sizeof(ox_face) == 16, ox_face_is_16_bytes);

// The separating planes that a region may part by, in the frame of B: faces of either mesh, and
// common normals of two edges. Each field lies for itself, so that many planes are looked at at a
// time (contacts/fields.h): of a region with m members there is room for OX_PLANES_PER_FEATURE * m.
#define OX_PLANE_NORMAL 0u   // three: unit, the way A is moved
#define OX_PLANE_LEVEL 3u    // two, of A and B: to where it has to go the way it is moved [m]
#define OX_PLANE_FLAGS 5u    // OX_PLANE_..., a kind, with CROSSED, PASSED, MEASURED
#define OX_PLANE_ID 6u       // two: of a face its triangle, 0; else the edges, of A and of B
#define OX_PLANE_OF_BODY 8u  // [m] of a face: so deep below it the body that it clears is at least
#define OX_PLANE_WORDS 9u

// What may become a contact, in the frame of B, each field for itself: a feature makes one, and for
// units that it takes several planes to separate there is room for as many more.
#define OX_CANDIDATES_PER_FEATURE 2u
#define OX_CANDIDATE_POSITION 0u  // three
#define OX_CANDIDATE_NORMAL 3u    // three, into A
#define OX_CANDIDATE_DEPTH 6u
#define OX_CANDIDATE_DISTANCE2 7u  // [m^2] to the nearest contact already taken
#define OX_CANDIDATE_SIDE_KIND 8u  // OX_HIT_REVERSED, OX_HIT_SIDE, OX_HIT_POINT
#define OX_CANDIDATE_VERTEX 9u     // of a point: the triangle of the source, over all triangles
#define OX_CANDIDATE_TRIANGLE 10u
#define OX_CANDIDATE_MANIFOLD 11u  // the plane that it is a contact of, among those of its region
#define OX_CANDIDATE_REGION 12u    // OX_REGION_KEY
#define OX_CANDIDATE_TAKEN 13u     // contacts/reduce.cl
#define OX_CANDIDATE_FEATURE 14u   // two, of A and B: OX_OF
#define OX_CANDIDATE_WORDS 16u

// Places in the table of features for each of them: a crossing has an edge and, with another, two
// pairs of facets. In that of faces: a crossing has three. And planes: those, and a pair of
// edges for two crossings that share a pair of facets.
#define OX_SLOTS_PER_FEATURE 4u
#define OX_FACES_PER_FEATURE 3u
#define OX_PLANES_PER_FEATURE 4u

#endif
