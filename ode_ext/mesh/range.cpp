// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/range.h"

#include <sstream>

#include "mesh/box.h"
#include "mesh/measures.h"

namespace ode_ext {

std::string why_refused(const SourceTriangles& source) {
  if (source.empty()) return {};
  if (!is_finite(source)) return "has a vertex that is not finite";
  const Box box = box_of(source);
  const double farthest = length(Vec3d(farthest_corner(box)));
  const double size = length(extent(box));
  std::ostringstream reason;
  if (farthest > kFarthestCorner)
    reason << "reaches " << farthest << " m from its origin, beyond " << kFarthestCorner << " m";
  else if (size < kSmallestMesh)
    reason << "is " << size << " m across, less than " << kSmallestMesh << " m";
  return reason.str();
}

}  // namespace ode_ext
