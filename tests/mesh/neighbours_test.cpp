// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/edge_pairs.h"
#include "mesh/ray_cast.h"
#include "shapes.h"

namespace ode_ext {
namespace {

bool runs_edge(const Triangle& triangle, std::uint32_t from, std::uint32_t to) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (triangle[k] == from && triangle[(k + 1) % 3] == to) return true;
  }
  return false;
}

// The slow way: every triangle that has the edge, in either direction.
std::uint32_t expected(const std::vector<Triangle>& triangles, std::uint32_t own, std::size_t k) {
  const std::uint32_t from = triangles[own][k], to = triangles[own][(k + 1) % 3];
  std::vector<std::uint32_t> others;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (i == own) continue;
    if (runs_edge(triangles[i], from, to) || runs_edge(triangles[i], to, from)) others.push_back(i);
  }
  if (others.size() != 1 || !runs_edge(triangles[others[0]], to, from)) return kNone;
  return others[0];
}

std::vector<Neighbours> neighbours_of(const std::vector<Triangle>& triangles) {
  return neighbours(triangles.size(), half_edges_of(triangles));
}

std::vector<Neighbours> neighbours_of(const TriangleSoup& soup) {
  return neighbours_of(build_mesh(soup).topology->triangles);
}

void expect_as_the_slow_way(const TriangleSoup& soup) {
  const Mesh mesh = build_mesh(soup);
  const std::vector<Neighbours> found = neighbours_of(mesh.topology->triangles);
  ASSERT_EQ(found.size(), mesh.topology->triangles.size());
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(found[i][k], expected(mesh.topology->triangles, i, k)) << i << " " << k;
    }
  }
}

std::size_t missing(const std::vector<Neighbours>& neighbours) {
  std::size_t count = 0;
  for (const Neighbours& across : neighbours) {
    count += static_cast<std::size_t>(std::count(across.begin(), across.end(), kNone));
  }
  return count;
}

TEST(Neighbours, AreThoseAcrossTheEdges) {
  for (const TriangleSoup& soup :
       {shapes::tetrahedron(), shapes::cube(), shapes::sphere(1, 8), shapes::torus(1, 0.3, 12)}) {
    expect_as_the_slow_way(soup);
    EXPECT_EQ(missing(neighbours_of(soup)), 0u);
  }
}

TEST(Neighbours, EndAtTheRimOfAnOpenMesh) {
  expect_as_the_slow_way(shapes::sheet(5));
  EXPECT_EQ(missing(neighbours_of(shapes::sheet(5))), 20u);
  expect_as_the_slow_way({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

TEST(Neighbours, AreNotToldWhereThreeMeet) {
  TriangleSoup fin = shapes::cube();
  shapes::append(fin, {0, 0, 0}, {1, 0, 0}, {0, -1, -1});
  expect_as_the_slow_way(fin);
  EXPECT_EQ(missing(neighbours_of(fin)), 5u);
}

TEST(Neighbours, AreNotToldWhereFourMeetThatAreNoPairs) {
  const std::vector<Triangle> same_way{{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 0, 5}};
  EXPECT_EQ(missing(neighbours_of(same_way)), 12u);
}

// Two cubes that touch along an edge: each goes on over it.
TEST(Neighbours, AreOfOneSolidWhereFourMeet) {
  const TriangleSoup two = shapes::joined(shapes::cube(), shapes::box({1, 1, 0}, {2, 2, 1}));
  const Mesh mesh = build_mesh(two);
  std::vector<HalfEdge> half_edges = half_edges_of(mesh.topology->triangles);
  pair_by_solids(mesh.vertices, mesh.topology->triangles, half_edges);
  const std::vector<Neighbours> found = neighbours(24, half_edges);
  EXPECT_EQ(missing(found), 0u);
  for (std::uint32_t t = 0; t < 24; ++t)
    for (const std::uint32_t next : found[t])
      EXPECT_EQ(mesh.topology->source_triangle[t] / 12, mesh.topology->source_triangle[next] / 12);
}

TEST(Neighbours, MustRunTheEdgeTheOtherWay) {
  const Triangle one{0, 1, 2}, same_way{0, 1, 3}, other_way{1, 0, 3};
  EXPECT_EQ(neighbours_of({one, same_way}),
            (std::vector<Neighbours>{{kNone, kNone, kNone}, {kNone, kNone, kNone}}));
  EXPECT_EQ(neighbours_of({one, other_way}),
            (std::vector<Neighbours>{{1, kNone, kNone}, {0, kNone, kNone}}));
}

TEST(Neighbours, OfNothingAreNone) { EXPECT_TRUE(neighbours(0, half_edges_of({})).empty()); }

}  // namespace
}  // namespace ode_ext
