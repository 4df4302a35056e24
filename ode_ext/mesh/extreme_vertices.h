// SPDX-License-Identifier: BSD-3-Clause
// Which vertices of a mesh can be the outermost of all that is near them.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/edges.h"
#include "mesh/neighbours.h"
#include "mesh/triangle.h"
#include "mesh/vec.h"

namespace ode_ext {

// A vertex is extreme if a plane through it has all of the solid about it on one side. However far
// any other reaches along some direction, one of its neighbours reaches as far, or farther: so it
// says nothing about how deep the solid is in another one.
//
// For each vertex 1, or 0 if it is surely not extreme, or within a facet, which has its corners. Of
// what is not known it is 1: at a border, where triangles meet there that are no neighbours, and
// where many do. `edges` are those between facets, `normals` the angle-weighted ones of vertices.
std::vector<std::uint8_t> extreme_vertices(const std::vector<Vec3f>& vertices,
                                           const std::vector<Triangle>& triangles,
                                           const std::vector<Neighbours>& neighbours,
                                           const std::vector<Edge>& edges,
                                           const std::vector<Vec3f>& normals);

}  // namespace ode_ext
