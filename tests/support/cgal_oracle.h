// SPDX-License-Identifier: BSD-3-Clause
// Do the surfaces of two meshes intersect, answered by CGAL with exact predicates: only the
// placing of the vertices is rounded, to double. A second opinion on FCL; slow.
#pragma once

#include "support/mesh_makers.h"

namespace ode_ext::test {

bool surfaces_intersect_exactly(const TestMesh& a, const TestPose& pa, const TestMesh& b,
                                const TestPose& pb);

}  // namespace ode_ext::test
