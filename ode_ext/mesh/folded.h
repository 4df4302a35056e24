// SPDX-License-Identifier: BSD-3-Clause
// Needles that rounding has folded: two triangles that cover one another from both sides, and are
// no higher than what rounding does to a corner.
#pragma once

#include "mesh/weld.h"

namespace ode_ext {

// Leaves them out, and vertices that no other triangle has, but where nothing else is. A solid that
// is cut into needles stays one so: with faces that cover one another it would be an open mesh. The
// triangles are in the order of order_by_vertices.
void leave_out_folded(WeldedMesh& mesh);

}  // namespace ode_ext
