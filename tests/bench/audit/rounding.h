// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "geometry/mesh_oracle.h"
#include "support/mesh_makers.h"

namespace ode_ext::audit {

// [m] What the collider allows for rounding at this pair's coordinates (pair_step.cl); whatever is
// less deep than that is on the surface for it.
inline double rounding(const oracle::Mesh& a, const test::TestPose& pa, const oracle::Mesh& b,
                       const test::TestPose& pb) {
  // sqrt(3): it adds up the components of the offset.
  const double offset = std::sqrt(3.0) * test::distance(pa.position, pb.position);
  return 0x1p-20 * (offset + std::sqrt(3.0) * (a.radius() + b.radius()));
}

}  // namespace ode_ext::audit
