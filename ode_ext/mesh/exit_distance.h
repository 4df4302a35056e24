// SPDX-License-Identifier: BSD-3-Clause
// How deep below each vertex a mesh is solid.
#pragma once

#include <limits>
#include <vector>

#include "mesh/bvh.h"
#include "mesh/vec.h"

namespace ode_ext {

// For each vertex the t at which the ray along -normal leaves a closed mesh (GRAPP section 3, from
// Hermann 2008: contacts beyond it are not the vertex's own). Parts of it may overlap, abut or lie
// in one another: it leaves where it has left as often as it had entered, its start among that; of
// parts that are flush with one another it meets one wall. Infinity where it never does, as from a
// vertex that it starts outside from, nor behind the first 16 walls; 0 for a vertex without a
// normal. An open mesh is taken to be solid down to `thickness` [m] at most.
std::vector<float> exit_distances(const std::vector<Vec3f>& vertices,
                                  const std::vector<Vec3f>& normals,
                                  const std::vector<Triangle>& triangles, const Bvh& bvh,
                                  float thickness = std::numeric_limits<float>::infinity());

}  // namespace ode_ext
