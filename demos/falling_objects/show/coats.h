// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "falling_objects/show/mesh_of_geom.h"

namespace falling_objects {

inline constexpr std::size_t kCoats = 8;

// The triangles of a mesh by colors, kCoats of them, so that meshlets with a corner in common have
// different ones, as far as there are enough. `meshlets`: of each triangle its meshlet, or -1.
std::vector<std::vector<unsigned>> coats_of(const IndexedMesh& mesh,
                                            const std::vector<int>& meshlets);

}  // namespace falling_objects
