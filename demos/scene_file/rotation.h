// SPDX-License-Identifier: BSD-3-Clause
// Rotations as unit quaternions w, x, y, z.
#pragma once

#include "meshes/random.h"
#include "scene_file/scene_description.h"

namespace falling_objects {

// The same direction, exactly, of a length from 1 to 4, since the square of a length may be 0 or
// infinite. `axis` is finite and not 0.
Point direction_of(const Point& axis);

// `axis` need not be of length 1; `angle` in [rad].
Quaternion rotation_about(const Point& axis, double angle);

// `second` after `first`.
Quaternion product(const Quaternion& second, const Quaternion& first);

Point rotate(const Quaternion& q, const Point& p);

// Uniform over all rotations (Shoemake 1992).
Quaternion random_rotation(Random& random);

}  // namespace falling_objects
