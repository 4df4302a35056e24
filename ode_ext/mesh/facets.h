// SPDX-License-Identifier: BSD-3-Clause
// Flat pieces of surface, however many triangles they are made of.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/neighbours.h"
#include "mesh/vec.h"

namespace ode_ext {

// For each triangle the number of its facet: connected triangles whose normals differ from that of
// the largest of them by less than 0.1 degrees. Compared with one triangle, not with the next, so
// that a finely cut sphere is not flat. Triangles of no area are facets of their own. The numbers
// go by size and place and do not depend on the order of the triangles.
std::vector<std::uint32_t> facets(const std::vector<Vec3f>& vertices,
                                  const std::vector<Triangle>& triangles,
                                  const std::vector<Vec3f>& face_normals,
                                  const std::vector<Neighbours>& neighbours);

}  // namespace ode_ext
