// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/vertex_chunks.h"

#include <algorithm>

namespace ode_ext {

std::vector<VertexChunk> cut_into_chunks(const std::vector<Vec3f>& vertices) {
  std::vector<VertexChunk> chunks;
  const auto total = static_cast<std::uint32_t>(vertices.size());
  for (std::uint32_t first = 0; first < total; first += kChunkVertices) {
    VertexChunk chunk{first, std::min(kChunkVertices, total - first), empty_box()};
    for (std::uint32_t i = first; i < first + chunk.count; ++i) {
      chunk.box = grown(chunk.box, vertices[i]);
    }
    chunks.push_back(chunk);
  }
  return chunks;
}

}  // namespace ode_ext
