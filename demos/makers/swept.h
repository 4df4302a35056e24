// SPDX-License-Identifier: BSD-3-Clause
// Round wire bent in the x-z plane. Closed, wound outwards; lengths in meters.
#pragma once

#include "meshes/triangle_mesh.h"

namespace falling_objects {

// A link of a chain, long along z, about the origin. `length` and `width` are those of the opening:
// links that hang in each other taut are `length` apart.
TriangleMesh make_link(double length, double width, double wire, unsigned sides);

// Half a circle open to above, with the middle at the origin and of `radius` to the middle of the
// wire; its left end goes on upwards by `shank`, its right one by `tip`. Both ends are round.
TriangleMesh make_hook(double radius, double shank, double tip, double wire, unsigned sides);

}  // namespace falling_objects
