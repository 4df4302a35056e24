// SPDX-License-Identifier: BSD-3-Clause
// Bodies that stand upright, or nearly.
#pragma once

#include <cmath>
#include <numbers>

#include "support/mesh_makers.h"
#include "support/test_scene.h"

namespace ode_ext::test {

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// The lowest vertex of a mesh that is turned.
inline Point lowest_of(const TestMesh& mesh, const TestPose& turned) {
  Point lowest{0, 0, 1e9};
  for (int i = 0; i < mesh.vertex_count(); ++i) {
    const Point p = rotate(turned, mesh.vertex(static_cast<std::size_t>(i)));
    if (p[2] < lowest[2]) lowest = p;
  }
  return lowest;
}

// Up to `most` off upright, turned by anything about z first.
inline TestPose tilted(Random& random, double most, const TestPose& upright) {
  const double around = random.uniform(0, 2 * std::numbers::pi);
  const double about = random.uniform(0, 2 * std::numbers::pi);
  const double tilt = random.uniform(0, most);
  return composed(turned({std::cos(around), std::sin(around), 0}, tilt),
                  composed(turned({0, 0, 1}, about), upright));
}

}  // namespace ode_ext::test
