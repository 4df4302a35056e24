// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/vertex_chunks.h"

#include <algorithm>

namespace ode_ext {

std::vector<VertexChunk> cut_into_chunks(const std::vector<Vec3f>& vertices) {
  std::vector<VertexChunk> chunks;
  const auto total = static_cast<std::uint32_t>(vertices.size());
  for (std::uint32_t first = 0; first < total; first += kChunkVertices) {
    VertexChunk chunk{first, std::min(kChunkVertices, total - first), empty_box(), false};
    for (std::uint32_t i = first; i < first + chunk.count; ++i) {
      chunk.box = grown(chunk.box, vertices[i]);
    }
    chunks.push_back(chunk);
  }
  return chunks;
}

void find_joined(const std::vector<Edge>& edges, const std::vector<Edge>& flat_edges,
                 std::vector<VertexChunk>& chunks) {
  // For each vertex a bit for itself and for each of its chunk that an edge joins it to.
  std::vector<std::uint16_t> neighbours;
  static_assert(kChunkVertices == 16);
  for (const VertexChunk& chunk : chunks)
    for (std::uint32_t i = 0; i < chunk.count; ++i)
      neighbours.push_back(static_cast<std::uint16_t>(1u << i));
  for (const std::vector<Edge>* some : {&edges, &flat_edges})
    for (const Edge& edge : *some) {
      const auto [a, b] = edge.vertices;
      if (a / kChunkVertices != b / kChunkVertices) continue;
      neighbours[a] = static_cast<std::uint16_t>(neighbours[a] | 1u << b % kChunkVertices);
      neighbours[b] = static_cast<std::uint16_t>(neighbours[b] | 1u << a % kChunkVertices);
    }
  for (VertexChunk& chunk : chunks) {
    unsigned reached = 1, before = 0;
    while (reached != before) {
      before = reached;
      for (std::uint32_t i = 0; i < chunk.count; ++i)
        if ((before >> i & 1u) != 0) reached |= neighbours[chunk.first + i];
    }
    chunk.joined = reached == (1u << chunk.count) - 1;
  }
}

}  // namespace ode_ext
