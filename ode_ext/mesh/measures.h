// SPDX-License-Identifier: BSD-3-Clause
// What is measured of a mesh, built or deformed.
#pragma once

#include <vector>

#include "mesh/box.h"
#include "mesh/mesh.h"

namespace ode_ext {

// The mean length of the sides of all triangles [m]; an edge inside the mesh counts once for each
// of them.
float mean_side(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles);

// The length of the vector area over the area: 0 of what is closed, 1 of what is flat, or of no
// area.
float vector_area_share(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles);

// The largest distance of a corner from centre(box), rounded up [m].
float half_diagonal(const Box& box);

// The nearest float that is not below.
float rounded_up(double value);

}  // namespace ode_ext
