// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/half_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "shapes.h"

namespace ode_ext {
namespace {

TEST(HalfEdges, AreAllSidesOfAllTrianglesEdgeByEdge) {
  for (const TriangleSoup& soup : {shapes::cube(), shapes::sheet(3), shapes::torus(1, 0.3, 7)}) {
    const std::vector<Triangle> triangles = build_mesh(soup).topology->triangles;
    const std::vector<HalfEdge> edges = half_edges_of(triangles);
    ASSERT_EQ(edges.size(), 3 * triangles.size());
    std::set<std::uint32_t> sides;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const HalfEdge& edge = edges[i];
      const Triangle& triangle = triangles.at(edge.side / 3);
      const std::uint32_t corner = edge.side % 3;
      const std::uint32_t from = triangle[corner], to = triangle[(corner + 1) % 3];
      EXPECT_EQ(edge.low, std::min(from, to));
      EXPECT_EQ(edge.high, std::max(from, to));
      EXPECT_EQ(edge.upward, from < to);
      EXPECT_TRUE(sides.insert(edge.side).second);
      if (i == 0) continue;
      const HalfEdge& last = edges[i - 1];
      EXPECT_LT(std::tie(last.low, last.high, last.side), std::tie(edge.low, edge.high, edge.side));
      EXPECT_EQ(same_edge(last, edge), last.low == edge.low && last.high == edge.high);
    }
  }
}

TEST(HalfEdges, OfNothingAreNone) { EXPECT_TRUE(half_edges_of({}).empty()); }

}  // namespace
}  // namespace ode_ext
