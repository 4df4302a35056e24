// SPDX-License-Identifier: BSD-3-Clause
// Vertices cut into runs of one work-group.
#pragma once

#include <vector>

#include "mesh/edges.h"
#include "mesh/mesh.h"

namespace ode_ext {

// Runs of kChunkVertices, the last one shorter, each with its tight box.
std::vector<VertexChunk> cut_into_chunks(const std::vector<Vec3f>& vertices);

// Finds which of all chunks of a mesh are joined by its edges.
void find_joined(const std::vector<Edge>& edges, const std::vector<Edge>& flat_edges,
                 std::vector<VertexChunk>& chunks);

}  // namespace ode_ext
