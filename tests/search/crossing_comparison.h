// SPDX-License-Identifier: BSD-3-Clause
// Crossings that the search found beside those of the brute-force reference.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "reference/reference_crossings.h"
#include "support/rig.h"
#include "support/test_scene.h"

namespace ode_ext::test {

// Pair, side, the ends of the edge in its own frame, the triangle crossed as in its TestMesh.
using CrossingKey = std::tuple<std::size_t, int, Point, Point, int>;

struct FoundCrossing {
  double t;  // [m] from the lesser end
  bool leaves;
};

// Those within facets, which are there for the flood alone, are left out. Throws
// std::runtime_error where one edge crosses one triangle twice.
std::map<CrossingKey, FoundCrossing> found_crossings(const TestScene& scene,
                                                     const StepRecords& records);

struct Comparison {
  std::size_t certain = 0, ambiguous = 0;  // of the reference
  std::size_t found = 0;                   // by the search
  std::vector<std::string> differences;    // beyond rounding, a line each
};

// `surfaces`: of the scene's meshes.
Comparison compare_crossings(const TestScene& scene, const std::vector<ReferenceSurface>& surfaces,
                             const std::map<CrossingKey, FoundCrossing>& found);

}  // namespace ode_ext::test
