// SPDX-License-Identifier: BSD-3-Clause
// Vertices cut into runs of one work-group.
#pragma once

#include <vector>

#include "mesh/mesh.h"

namespace ode_ext {

// Runs of kChunkVertices, the last one shorter, each with its tight box.
std::vector<VertexChunk> cut_into_chunks(const std::vector<Vec3f>& vertices);

}  // namespace ode_ext
