// SPDX-License-Identifier: BSD-3-Clause
// A gear whose teeth roll on those of any other of the same module: flanks are involutes, so that
// the ratio of two that mesh is that of their numbers of teeth at every moment.
#pragma once

#include "meshes/triangle_mesh.h"

namespace falling_objects {

struct SpurGear {
  unsigned teeth;
  double module;     // pitch diameter over teeth [m]
  double thickness;  // [m], along z
  double backlash;   // by which a tooth is thinner than the gap it is in, at the pitch circle [m]
  double bore;       // radius of the hole [m]; 0: none
};

// About z, with the middle of a tooth on the x axis.
TriangleMesh make_spur_gear(const SpurGear& gear);

}  // namespace falling_objects
