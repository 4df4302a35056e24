// SPDX-License-Identifier: BSD-3-Clause
// Flat ground of many triangles. The top of each is at half its thickness above the origin, so that
// one box is the yardstick of all.
#pragma once

#include "bench/stability/shape.h"

namespace ode_ext::stability {

struct GroundSize {
  double size = 8, thickness = 0.5;  // [m]
  int cells = 32;                    // quads along a side: 2,048 triangles on top
};

Shape regular_slab(const GroundSize& size);
// The vertices on top, but for those at the rim, moved at random in the plane.
Shape irregular_slab(const GroundSize& size, Random& random);
// The top alone, open.
Shape open_sheet(const GroundSize& size);

// Where to put the ground so that its top is z = 0.
inline TestPose ground_pose(const GroundSize& size, double x) {
  return at(x, 0, -size.thickness / 2);
}

}  // namespace ode_ext::stability
