// SPDX-License-Identifier: BSD-3-Clause
// Whether a triangle and a box overlap.
#pragma once

#include <array>

#include "geometry/vec.h"

namespace ode_ext {

// The thirteen separating axes of a triangle and an axis-aligned box (Akenine-Moeller 2001).
// Touching counts as overlap.
bool triangle_overlaps_box(const std::array<Vec3d, 3>& triangle, Vec3d box_centre, Vec3d half_size);

}  // namespace ode_ext
