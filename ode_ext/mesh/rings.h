// SPDX-License-Identifier: BSD-3-Clause
// Which vertices are joined by edges, and how many parts of a mesh that makes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/edges.h"

namespace ode_ext {

struct RingNeighbour {
  std::uint32_t vertex, edge;
};

struct Rings {
  // Of vertex v: neighbours[starts[v]] to before starts[v + 1], by their edges' order.
  std::vector<std::uint32_t> starts;
  std::vector<RingNeighbour> neighbours;
  // A vertex of each connected part, its lowest.
  std::vector<std::uint32_t> components;
};

Rings build_rings(std::size_t vertex_count, const std::vector<Edge>& edges);

}  // namespace ode_ext
