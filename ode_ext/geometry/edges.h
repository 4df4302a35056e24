// SPDX-License-Identifier: BSD-3-Clause
// The edges of a mesh that are worth casting: those between facets.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/box.h"
#include "geometry/neighbours.h"
#include "geometry/vec.h"

namespace ode_ext {

struct Edge {
  std::array<std::uint32_t, 2> vertices;   // ascending
  std::array<std::uint32_t, 2> triangles;  // the second is kNone where there is none
};

// In runs by their middles (runs.h). `facets` as facets.h gives them; empty: every edge. Where more
// than two triangles meet, they are taken two by two: each of them is at one of the edges.
std::vector<Edge> edges(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
                        const std::vector<std::uint32_t>& facets);

// A run of at most kChunkVertices consecutive edges.
struct EdgeChunk {
  std::uint32_t first;
  std::uint32_t count;
  Box box;
};

std::vector<EdgeChunk> cut_into_chunks(const std::vector<Edge>& edges,
                                       const std::vector<Vec3f>& vertices);

}  // namespace ode_ext
