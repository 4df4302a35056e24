// SPDX-License-Identifier: BSD-3-Clause
// What must hold of what a collider says beside contacts: of their ids, their regions, and the
// meshlets of meshes. A flaw is a sentence; "" is none.
#pragma once

#include <ode_ext/ode_ext.h>

#include <span>
#include <string>

#include "support/mesh_makers.h"

namespace ode_ext::fuzz {

// Each contact of a pair that a collider was asked for just now has an id of its own.
std::string unidentified(dBatchColliderID collider, std::span<const dContactGeom> contacts);

// Contacts of a pair, in the order of its answer.
struct Regions {
  std::span<const dBatchContactRegion> found;
  bool in_order = true;  // no contact before them was refused by the program
  bool crosses = true;   // the collider looks for crossings
};
// They are numbered in the order in which they come up, and all contacts of one overlap alike.
std::string misnumbered(const Regions& regions);
// All contacts that a collider was asked for just now are in regions that are not misnumbered, and
// the same with the arguments exchanged.
std::string misplaced(dBatchColliderID collider, std::span<const dContactGeom> contacts,
                      bool in_order, bool crosses);

// `count` meshlets, each of one to sixteen triangles, and only triangles with two corners in one
// place in none of them.
std::string scattered(std::span<const int> meshlets, int count, const test::TestMesh& mesh);

}  // namespace ode_ext::fuzz
