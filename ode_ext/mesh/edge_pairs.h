// SPDX-License-Identifier: BSD-3-Clause
// Which triangles belong together where more than two meet at an edge, as two cubes do that touch
// along one: those between which the solid is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/half_edges.h"
#include "mesh/vec.h"

namespace ode_ext {

// The corner of a half-edge's triangle that is not on the edge.
inline std::uint32_t apex_of(const std::vector<Triangle>& triangles, const HalfEdge& half_edge) {
  return triangles[half_edge.side / 3][(half_edge.side % 3 + 2) % 3];
}

// One past the last half-edge of the edge that begins at `begin`.
std::size_t end_of_edge(const std::vector<HalfEdge>& half_edges, std::size_t begin);

// Whether the half-edges of an edge, [begin, end), are pairs that run it in opposite directions.
bool are_pairs(const std::vector<HalfEdge>& half_edges, std::size_t begin, std::size_t end);

// Whether each edge is run as often one way as the other. Then it is known of every point how often
// the triangles wind about it, and what they wind about is a solid (the boundary of a chain).
bool is_boundary(const std::vector<HalfEdge>& half_edges);

// Whether more than two triangles meet at an edge.
bool has_shared(const std::vector<HalfEdge>& half_edges);

// Whether two triangles at an edge of more than two have the same corners.
bool has_coincident(const std::vector<Triangle>& triangles,
                    const std::vector<HalfEdge>& half_edges);

// Of each edge with more than two triangles that is run as often one way as the other, brings those
// half-edges beside one another between which the solid is. All others stay where they are.
void pair_by_solids(const std::vector<Vec3f>& vertices, const std::vector<Triangle>& triangles,
                    std::vector<HalfEdge>& half_edges);

// The same of a mesh that deforms, whose triangles turn about their edges: by their numbers.
void pair_by_number(std::vector<HalfEdge>& half_edges);

}  // namespace ode_ext
