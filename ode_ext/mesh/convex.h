// SPDX-License-Identifier: BSD-3-Clause
// Whether a mesh is convex.
#pragma once

#include "mesh/mesh.h"

namespace ode_ext {

// Closed, of one part, and at none of its edges does a face rise over the plane of the other by
// more than is not known of two coordinates. False of a deformable mesh, whose vertices move.
bool is_convex(const Mesh& mesh);

}  // namespace ode_ext
