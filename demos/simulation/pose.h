// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ode/ode.h>

#include "geometry/vector.h"

namespace falling_objects {

inline ode_ext::oracle::Vector vector_of(const dReal* v) { return {v[0], v[1], v[2]}; }

// Of no body: that of the world.
inline ode_ext::oracle::Pose pose_of(dBodyID body) {
  if (body == nullptr) return {};
  const dReal* r = dBodyGetRotation(body);  // rows of four
  return {{{{r[0], r[1], r[2]}, {r[4], r[5], r[6]}, {r[8], r[9], r[10]}}},
          vector_of(dBodyGetPosition(body))};
}

}  // namespace falling_objects
