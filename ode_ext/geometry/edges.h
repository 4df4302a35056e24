// SPDX-License-Identifier: BSD-3-Clause
// The edges of a mesh that are worth casting: those between facets.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/neighbours.h"
#include "geometry/vec.h"

namespace ode_ext {

struct Edge {
  std::array<std::uint32_t, 2> vertices;   // ascending
  std::array<std::uint32_t, 2> triangles;  // the second is kNone where there is none
};

// Those between facets, in runs by their middles (runs.h); `facets` as facets.h gives them. Where
// these are empty: every edge, by its vertices. Where more than two triangles meet, they are taken
// two by two: each of them is at one of the edges.
std::vector<Edge> edges(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
                        const std::vector<std::uint32_t>& facets);

}  // namespace ode_ext
