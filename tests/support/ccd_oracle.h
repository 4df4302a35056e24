// SPDX-License-Identifier: BSD-3-Clause
// Depth and direction of the penetration of two convex meshes, by libccd (GJK and EPA).
#pragma once

#include "support/mesh_makers.h"

namespace ode_ext::test {

struct ConvexPenetration {
  bool overlap = false;
  double depth = 0;   // [m] the least separation, to kEpaTolerance
  Point direction{};  // unit, world: moving a by depth * direction separates the two
};

// [m] per metre of size: what libccd is asked for.
inline constexpr double kEpaTolerance = 1e-6;

// The hulls of the vertices; equal to the meshes where these are convex.
ConvexPenetration convex_penetration(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                     const TestPose& pb);

}  // namespace ode_ext::test
