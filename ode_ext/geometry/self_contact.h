// SPDX-License-Identifier: BSD-3-Clause
// Whether a mesh touches itself.
#pragma once

#include <vector>

#include "geometry/bvh.h"
#include "geometry/vec.h"

namespace ode_ext {

// False only if no two triangles come as near as `distance` [m] to one another, except at the
// corners and edges that they share. True, too, where so many boxes of triangles overlap that it
// would take long to tell. `distance` must be at least 2^-22 of the coordinates.
bool touches_itself(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
                    const std::vector<Vec3f>& face_normals, const Bvh& bvh, double distance);

}  // namespace ode_ext
