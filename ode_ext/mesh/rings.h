// SPDX-License-Identifier: BSD-3-Clause
// Which vertices are joined by edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/edges.h"

namespace ode_ext {

struct RingNeighbour {
  std::uint32_t vertex, edge;
};

// Of vertex v: neighbours[starts[v]] to before starts[v + 1], by their edges' order.
struct Rings {
  std::vector<std::uint32_t> starts;
  std::vector<RingNeighbour> neighbours;
};

// Edges count those between facets first, then those within one, as in MeshTopology.
Rings build_rings(std::size_t vertex_count, const std::vector<Edge>& edges,
                  const std::vector<Edge>& flat_edges);

}  // namespace ode_ext
