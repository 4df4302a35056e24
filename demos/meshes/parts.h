// SPDX-License-Identifier: BSD-3-Clause
// The parts of a mesh: triangles that share vertices, directly or by others.
#pragma once

#include "meshes/triangle_mesh.h"

namespace falling_objects {

// Turns each part of a closed mesh that is inside no other so that its volume is positive, and with
// it all that is inside it: what is wound the other way in there is a cavity.
void turn_parts_outwards(TriangleMesh& mesh);

}  // namespace falling_objects
