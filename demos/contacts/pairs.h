// SPDX-License-Identifier: BSD-3-Clause
// Two bodies each, in a pose that says something about contacts.
#pragma once

#include <span>

#include "contacts/mesh.h"

namespace contacts {

struct Placed {
  Mesh mesh;
  dVector3 position;
  dQuaternion turn;
};

struct Pair {
  const char* name;
  const char* sentence;
  Placed (*upper)();
  Placed (*lower)();
  double depth;  // [m] of the overlap, along z
};

std::span<const Pair> all_pairs();

}  // namespace contacts
