// SPDX-License-Identifier: BSD-3-Clause
// Bodies that were lowered by so much from where they touch: up by that they are out.
#pragma once

#include "support/fcl_oracle.h"
#include "support/mesh_makers.h"

namespace ode_ext::test {

// A pose between `from` and `to` above 0, from where the body meets the ground on its way down on
// by `by` more [m].
inline TestPose lowered_onto(const FclSurface& ground, const TestMesh& body, TestPose pose,
                             double from, double to, double by) {
  const FclSurface surface(body);
  for (int i = 0; i < 20; ++i) {
    pose.position[2] = 0.5 * (from + to);
    (surfaces_intersect(surface, pose, ground, TestPose{}) ? to : from) = pose.position[2];
  }
  pose.position[2] -= by;
  return pose;
}

}  // namespace ode_ext::test
