// SPDX-License-Identifier: BSD-3-Clause
// The sides of triangles, brought together by edge.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/bvh.h"

namespace ode_ext {

struct DirectedEdge {
  std::uint32_t low, high;  // corners
  std::uint32_t side;       // 3 * triangle + first corner
  bool upward;              // runs from `low` to `high`
};

inline bool same_edge(const DirectedEdge& a, const DirectedEdge& b) {
  return a.low == b.low && a.high == b.high;
}

// The sides of an edge follow one another, by triangle.
std::vector<DirectedEdge> sorted_edges(const std::vector<Triangle>& triangles);

}  // namespace ode_ext
