// SPDX-License-Identifier: BSD-3-Clause
// Flat pieces of surface, however many triangles they are made of.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/neighbours.h"
#include "mesh/vec.h"

namespace ode_ext {

// For each triangle its facet, by the number of its largest triangle: connected triangles whose
// normals differ from that one's by less than 0.1 degrees, or which face as it does and lie in its
// plane as far as is known: the thinner a needle, the farther rounding turns it. Compared with one
// triangle, not with the next, so that a finely cut sphere is not flat. Triangles of no area are
// facets of their own. Of several that are as large the first by place is taken.
std::vector<std::uint32_t> facets(const std::vector<Vec3f>& vertices,
                                  const std::vector<Triangle>& triangles,
                                  const std::vector<Vec3f>& face_normals,
                                  const std::vector<Neighbours>& neighbours);

}  // namespace ode_ext
