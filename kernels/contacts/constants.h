// SPDX-License-Identifier: BSD-3-Clause
// All that contacts depend on and that is chosen, not derived, but for the direction of the shift
// of general position (lib/exact_sign.h). docs/planes.md says what each was chosen by. Device
// only.
#ifndef ODE_EXT_KERNELS_CONTACTS_CONSTANTS_H
#define ODE_EXT_KERNELS_CONTACTS_CONSTANTS_H

// Triangles of one facet are turned by as much against its largest [radians], 0.1 degrees
// (mesh/facets.cpp).
#define OX_FACET_ANGLE 0.00175f
// Edges that differ by less have no common normal that floats could tell [radians].
#define OX_PARALLEL 0.01f
// The cosine of what faces back.
#define OX_LOOKS_BACK -0.1f
// The cosine of what faces the same way, within 26 degrees.
#define OX_SAME_WAY 0.9f
// Planes are told apart by which coordinates of their normals are beyond that, either way.
#define OX_ASIDE (1.0f / 3.0f)
// A direction of which the best plane costs so many times the least is not looked around.
#define OX_WORTH 2.0f
// Contacts that face the same way, and are nearer to one another, hold a body no better than one;
// of the smaller radius, unless a body is thinner than that (contacts/reduce.cl). And what is less
// deep than so much of what goes on behind it is next to a plane (contacts/unit_plane.h).
#define OX_MERGE 0.02f
// Limits: of what there is mostly one of; of the planes of a region in units; of what is looked at
// one by one.
#define OX_FEW 4u
#define OX_MOST_PLANES 16u
#define OX_MANY 64u

#endif
