// SPDX-License-Identifier: BSD-3-Clause
// Needles that rounding has folded: two triangles that cover one another from both sides, and are
// no higher than what rounding does to a corner.
#pragma once

#include "mesh/weld.h"

namespace ode_ext {

// Leaves them out, and vertices that no other triangle has, unless nothing would be left. With
// faces that cover one another a solid that is cut into needles would be an open mesh. The
// triangles are in the order of order_by_vertices.
void leave_out_folded(WeldedMesh& mesh);

}  // namespace ode_ext
