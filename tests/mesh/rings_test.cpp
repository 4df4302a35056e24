// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "support/test_scene.h"

namespace ode_ext {
namespace {

using test::soup_of;

using Joints = std::set<std::pair<std::uint32_t, std::uint32_t>>;

Joints sides_of(const Mesh& mesh) {
  Joints sides;
  for (const Triangle& t : mesh.topology->triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      sides.emplace(t[k], t[(k + 1) % 3]);
      sides.emplace(t[(k + 1) % 3], t[k]);
    }
  return sides;
}

Rings rings_of(const Mesh& mesh) {
  return build_rings(mesh.vertices.size(), mesh.topology->edges, mesh.topology->flat_edges);
}

Joints joints_of(const Mesh& mesh) {
  const Rings rings = rings_of(mesh);
  Joints joints;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    for (std::uint32_t k = rings.starts[v]; k < rings.starts[v + 1]; ++k)
      joints.emplace(v, rings.neighbours[k].vertex);
  return joints;
}

// The lowest vertex of the part that each belongs to, the slow way.
std::vector<std::uint32_t> parts_of(const Joints& joints, std::size_t count) {
  std::vector<std::uint32_t> lowest(count);
  std::iota(lowest.begin(), lowest.end(), 0u);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [a, b] : joints)
      if (lowest[b] < lowest[a]) {
        lowest[a] = lowest[b];
        changed = true;
      }
  }
  return lowest;
}

TEST(Rings, JoinByEdgesOfTrianglesAllThatTheseJoin) {
  std::vector<test::TestMesh> meshes = test::small_meshes();
  meshes.push_back(test::make_cube(1, 6));
  meshes.push_back(test::merged(test::make_plate(1, 0.1, 5), test::moved(meshes[0], {5, 0, 0})));
  for (const test::TestMesh& made : meshes) {
    const Mesh mesh = build_mesh(soup_of(made));
    const Joints sides = sides_of(mesh), joints = joints_of(mesh);
    EXPECT_TRUE(std::includes(sides.begin(), sides.end(), joints.begin(), joints.end()));
    const auto parts = parts_of(sides, mesh.vertices.size());
    EXPECT_EQ(parts_of(joints, mesh.vertices.size()), parts);
    EXPECT_EQ(std::set<std::uint32_t>(parts.begin(), parts.end()),
              std::set<std::uint32_t>(mesh.topology->components.begin(),
                                      mesh.topology->components.end()));
  }
}

TEST(Chunks, AreJoinedWhereEdgesWithinThemLeadFromEachVertexToEach) {
  std::vector<test::TestMesh> meshes = test::small_meshes();
  meshes.push_back(test::make_icosphere(1, 4));
  meshes.push_back(test::make_plate(1, 0.01, 9));
  std::size_t joined = 0, apart = 0;
  for (const test::TestMesh& made : meshes) {
    const Mesh mesh = build_mesh(soup_of(made));
    Joints within;
    for (const auto& [a, b] : joints_of(mesh))
      if (a / kChunkVertices == b / kChunkVertices) within.emplace(a, b);
    const auto parts = parts_of(within, mesh.vertices.size());
    for (const VertexChunk& chunk : mesh.topology->chunks) {
      const auto first = parts.begin() + chunk.first;
      EXPECT_EQ(chunk.joined, std::all_of(first, first + chunk.count,
                                          [&](std::uint32_t part) { return part == chunk.first; }));
      ++(chunk.joined ? joined : apart);
    }
  }
  EXPECT_GT(joined, 0u);
  EXPECT_GT(apart, 0u);
}

TEST(Rings, NameTheEdgeToEachNeighbour) {
  const Mesh mesh = build_mesh(soup_of(test::make_cube(1, 3)));
  ASSERT_FALSE(mesh.topology->flat_edges.empty());
  std::vector<Edge> edges = mesh.topology->edges;
  edges.insert(edges.end(), mesh.topology->flat_edges.begin(), mesh.topology->flat_edges.end());
  const Rings rings = rings_of(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    for (std::uint32_t k = rings.starts[v]; k < rings.starts[v + 1]; ++k) {
      const RingNeighbour& neighbour = rings.neighbours[k];
      const auto& ends = edges.at(neighbour.edge).vertices;
      EXPECT_EQ(std::minmax(ends[0], ends[1]), std::minmax(v, neighbour.vertex));
    }
}

TEST(Rings, HaveAVertexOfEachComponent) {
  const test::TestMesh cube = test::make_cube(1, 2);
  EXPECT_EQ(build_mesh(soup_of(cube)).topology->components.size(), 1u);
  const auto three = test::merged(test::merged(cube, test::moved(cube, {3, 0, 0})),
                                  test::moved(test::make_icosphere(1, 1), {9, 0, 0}));
  const Mesh mesh = build_mesh(soup_of(three));
  ASSERT_EQ(mesh.topology->components.size(), 3u);
  std::multiset<long> places;
  for (const std::uint32_t v : mesh.topology->components)
    places.insert(std::lround(mesh.vertices[v].x / 4));
  EXPECT_EQ(places.count(2), 1u);
}

}  // namespace
}  // namespace ode_ext
