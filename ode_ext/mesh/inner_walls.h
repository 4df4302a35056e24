// SPDX-License-Identifier: BSD-3-Clause
// Walls inside a solid: where parts of a mesh abut, each has a face there that bounds nothing.
#pragma once

#include <vector>

#include "mesh/half_edges.h"
#include "mesh/weld.h"

namespace ode_ext {

// Leaves out each two triangles that have the same corners and face one another, and each two flat
// quads that do so and are cut by different diagonals, where what all others bound is a solid and
// they are inside it; and vertices that none has then. So boxes side by side, as of a world of
// voxels, become the solid that they are together. What faces one another elsewhere stays: it is a
// sheet that was given with both its sides. The triangles are in the order of order_by_vertices,
// the half-edges are theirs. False: nothing is left out.
bool leave_out_inner_walls(WeldedMesh& mesh, const std::vector<HalfEdge>& half_edges);

}  // namespace ode_ext
