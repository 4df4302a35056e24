// SPDX-License-Identifier: BSD-3-Clause
// What must hold of an answer whatever the meshes are, and what FCL and winding numbers say where
// they can be asked. A flaw is a sentence; "" is none.
#pragma once

#include <ode/ode.h>

#include <span>
#include <string>

#include "support/fcl_oracle.h"

namespace ode_ext::fuzz {

// How often each oracle was asked and could say something: a fuzzer that judges nothing finds
// nothing.
struct Tally {
  long long executions = 0, operations = 0;
  long long contacts = 0;   // looked at one by one
  long long colliding = 0;  // pairs whose surfaces intersect, and that had a contact
  long long contained = 0;  // pairs of solids, one in the other, that had a contact
  long long apart = 0;      // pairs of solids without either, and without a contact
  long long on_edge = 0;    // an answer that FCL contradicts, but not when a mesh is nudged
  long long unjudged = 0;   // pairs that no oracle can be asked about
  long long compared = 0;   // answers compared byte for byte with those of another collider
  long long meshlets = 0;   // of meshes of which all triangles were looked for in them
  long long stock = 0;      // pairs that stock ODE was timed with

  Tally& operator+=(const Tally& other);
};
// All of it, one line each.
std::string to_text(const Tally& tally);

// Contacts as they are for any input: finite, normals of length 1, not negative in depth, with the
// geoms that were asked for and with sides that exist.
struct Sides {
  dGeomID geom = nullptr;  // null: any is fine (a dGeomTransform names itself or what is in it)
  int triangles = 0;       // 0: any side is fine (a merge callback made it)
};
std::string malformed(std::span<const dContactGeom> contacts, const Sides& first,
                      const Sides& second);

// One mesh of a pair, as the oracles see it.
struct Subject {
  const test::TestMesh& mesh;
  const test::FclSurface* surface;  // null where the mesh is not tame()
  bool solid;                       // see DecodedMesh
  test::TestPose pose;
};

// Surfaces that intersect have a contact; solids of which one contains the other have one; solids
// that neither intersect nor contain one another have none.
std::string untrue(const Subject& a, const Subject& b, bool has_contact, Tally& tally);

}  // namespace ode_ext::fuzz
