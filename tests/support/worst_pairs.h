// SPDX-License-Identifier: BSD-3-Clause
// Pairs of which each once took minutes: much of one mesh meets much of the other.
#pragma once

#include <string>
#include <vector>

#include "support/mesh_makers.h"

namespace ode_ext::test {

struct WorstPair {
  std::string name;
  TestMesh a, b;
  TestPose pose;  // of b; a is where it was made
};

// Two copies of a ball, in one place but for a turn of a hundredth, of which no two triangles face
// quite the same way as their neighbours.
WorstPair rough_balls(int subdivisions);
WorstPair soups(int triangles);
WorstPair bundles_of_sticks(int sticks);
WorstPair finely_cut_cubes(int cuts);
WorstPair rough_sheet_in_a_face(int cuts);

// Of each of these a row of sizes, the smallest first.
std::vector<WorstPair> worst_pairs();

}  // namespace ode_ext::test
