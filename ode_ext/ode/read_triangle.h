// SPDX-License-Identifier: BSD-3-Clause
// What ODE says of a triangle. One call each, which takes ten times as long as reading it in the
// program's arrays (mesh_arrays.h): ODE has none that gives more.
#pragma once

#include <ode/ode.h>

#include <cstddef>

#include "mesh/vec.h"

namespace ode_ext {

// Three corners, of a geom at the identity in its own frame.
inline void read_triangle(dGeomID geom, std::size_t index, Vec3f* corners) {
  dVector3 exact[3];
  dGeomTriMeshGetTriangle(geom, static_cast<int>(index), &exact[0], &exact[1], &exact[2]);
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = {static_cast<float>(exact[k][0]), static_cast<float>(exact[k][1]),
                  static_cast<float>(exact[k][2])};
}

}  // namespace ode_ext
