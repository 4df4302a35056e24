// SPDX-License-Identifier: BSD-3-Clause
// Pairs of meshes made by hand, of which one sees in how many places they overlap.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::test {

struct RegionCase {
  std::string name;  // a word for a test's name
  TestMesh a, b;
  TestPose pose_a, pose_b;
  int regions;
};

std::vector<RegionCase> region_cases();

// How a failing test names its case.
inline void PrintTo(const RegionCase& c, std::ostream* out) { *out << c.name; }

}  // namespace ode_ext::test
