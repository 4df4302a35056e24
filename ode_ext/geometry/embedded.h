// SPDX-License-Identifier: BSD-3-Clause
// Whether a closed mesh is the boundary of a solid: a line that leaves it enters it again before it
// can leave it once more.
#pragma once

#include <cstddef>
#include <vector>

#include "geometry/bvh.h"
#include "geometry/neighbours.h"
#include "geometry/vec.h"

namespace ode_ext {

// Larger meshes are not examined, as they are not shared by the thousands.
inline constexpr std::size_t kMostExaminedTriangles = std::size_t{1} << 17;

// True only if no two triangles come nearer to one another than 2^-18 of the mesh's diagonal, or of
// its reach from the origin if that is larger, except at the corners and edges that they share, and
// if the space before each triangle is outside and that behind it inside. False when in doubt, for
// open meshes, for more than kMostExaminedTriangles, and where it would take long to tell
// (self_contact.h).
bool is_embedded(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
                 const std::vector<Neighbours>& neighbours, const Bvh& bvh,
                 const std::vector<Vec3f>& face_normals);

}  // namespace ode_ext
