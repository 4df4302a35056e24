// SPDX-License-Identifier: BSD-3-Clause
// The sides of triangles, brought together by edge: the one table from which it is found whether a
// mesh is closed, which triangles are neighbours, and what its edges are.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/triangle.h"

namespace ode_ext {

struct HalfEdge {
  std::uint32_t low, high;  // corners
  std::uint32_t side;       // 3 * triangle + first corner
  bool upward;              // runs from `low` to `high`
};

inline bool same_edge(const HalfEdge& a, const HalfEdge& b) {
  return a.low == b.low && a.high == b.high;
}

// The half-edges of an edge follow one another, by triangle.
std::vector<HalfEdge> half_edges_of(const std::vector<Triangle>& triangles);

}  // namespace ode_ext
