// SPDX-License-Identifier: BSD-3-Clause
// Poses of ODE geoms, as ODE has them.
#pragma once

#include <ode/ode.h>

#include "search/scene.h"

namespace ode_ext {

inline Pose to_pose(const dReal* position, const dReal* rotation) {
  Pose pose;
  pose.position = {position[0], position[1], position[2]};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      pose.rotation[3 * row + column] = rotation[4 * row + column];
  return pose;
}

inline Pose pose_of(dGeomID geom) {
  return to_pose(dGeomGetPosition(geom), dGeomGetRotation(geom));
}

}  // namespace ode_ext
