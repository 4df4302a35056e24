// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "support/mesh_makers.h"

namespace ode_ext::accuracy {

// [m] What the collider takes for rounding at this pair's coordinates: 2^-20 of the offset and the
// radii (pair_step.cl), whose components it adds up. What is nearer than that is the same to it.
inline double rounding(const test::TestMesh& a, const test::TestPose& pa, const test::TestMesh& b,
                       const test::TestPose& pb) {
  const double extents = test::distance(pa.position, pb.position) + mesh_size(a) + mesh_size(b);
  return 0x1p-20 * std::sqrt(3.0) * extents;
}

}  // namespace ode_ext::accuracy
