// SPDX-License-Identifier: BSD-3-Clause
// What whoever knows hash_soup can make: another mesh of the same hash.
#pragma once

#include <array>

#include "support/mesh_makers.h"

namespace ode_ext::test {

// A cube of 1 m and a plate of 0.2 x 8 x 8 m, of whose narrow sides some triangles go astray within
// 100 m of it. Both have twelve triangles with corners of their own, and their soups one hash.
std::array<TestMesh, 2> cube_and_plate_of_one_hash();

}  // namespace ode_ext::test
