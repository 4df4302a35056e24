// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/meshlets.h"

#include <gtest/gtest.h>

#include <set>

#include "mesh/box.h"
#include "mesh/mesh.h"
#include "support/test_scene.h"

namespace ode_ext {
namespace {

// A soup has three vertices and three edges of its own for each triangle.
TriangleSoup scattered(std::size_t triangles) {
  TriangleSoup soup;
  for (std::size_t i = 0; i < triangles; ++i) {
    const auto x = static_cast<float>(i);
    soup.insert(soup.end(), {{x, 0, 0}, {x + 0.5f, 0, 0}, {x, 1, 0.25f}});
  }
  return soup;
}

std::vector<TriangleSoup> soups() {
  return {test::soup_of(test::make_cube(1)),
          test::soup_of(test::make_icosphere(1, 3)),
          test::soup_of(test::make_torus(1, 0.3, 40, 20)),
          test::soup_of(test::make_sheet(2, 9)),
          scattered(1),
          scattered(100)};
}

TEST(Meshlets, HoldEachTriangleOnceAndItsVertices) {
  for (const TriangleSoup& soup : soups()) {
    const Mesh mesh = build_mesh(soup);
    std::uint32_t next = 0;
    for (const Meshlet& meshlet : mesh.topology->meshlets.meshlets) {
      EXPECT_EQ(meshlet.triangle_first, next);
      EXPECT_GE(meshlet.triangle_count, 1u);
      EXPECT_LE(meshlet.triangle_count, kMeshletTriangles);
      EXPECT_LE(meshlet.vertex_count, kMeshletVertices);
      next += meshlet.triangle_count;
      std::set<std::uint32_t> expected, held;
      for (std::uint32_t k = meshlet.triangle_first; k < next; ++k)
        for (const std::uint32_t vertex :
             mesh.topology->triangles[mesh.topology->meshlets.triangles[k]])
          expected.insert(vertex);
      for (std::uint32_t k = 0; k < meshlet.vertex_count; ++k)
        EXPECT_TRUE(held.insert(mesh.topology->meshlets.vertices[meshlet.vertex_first + k]).second);
      EXPECT_EQ(held, expected);
    }
    EXPECT_EQ(next, mesh.topology->triangles.size());
  }
}

TEST(Meshlets, OwnEachEdgeOnceAndHaveItsEnds) {
  for (const TriangleSoup& soup : soups()) {
    const Mesh mesh = build_mesh(soup);
    std::set<std::uint32_t> owned;
    for (const Meshlet& meshlet : mesh.topology->meshlets.meshlets) {
      EXPECT_LE(meshlet.edge_count, kMeshletEdges);
      for (std::uint32_t k = 0; k < meshlet.edge_count; ++k) {
        const std::uint32_t edge = mesh.topology->meshlets.edges[meshlet.edge_first + k];
        EXPECT_TRUE(owned.insert(edge).second);
        const auto first = mesh.topology->meshlets.vertices.begin() + meshlet.vertex_first;
        for (const std::uint32_t end : mesh.topology->edge(edge).vertices)
          EXPECT_EQ(std::count(first, first + meshlet.vertex_count, end), 1);
      }
    }
    EXPECT_EQ(owned.size(), mesh.topology->edges.size() + mesh.topology->flat_edges.size());
  }
}

// Sixteen lanes are for sixteen triangles: where vertices are shared, three quarters are in use.
TEST(Meshlets, AreThreeQuartersFull) {
  for (const TriangleSoup& soup : {test::soup_of(test::make_icosphere(1, 4)),
                                   test::soup_of(test::make_torus(1, 0.3, 64, 32))}) {
    const Mesh mesh = build_mesh(soup);
    EXPECT_LT(3 * mesh.topology->meshlets.meshlets.size() * kMeshletTriangles,
              4 * mesh.topology->triangles.size());
  }
}

TEST(Meshlets, OfNothingAreNone) {
  const Mesh mesh = build_mesh({});
  EXPECT_TRUE(mesh.topology->meshlets.meshlets.empty());
  EXPECT_TRUE(mesh.topology->meshlets.tree.empty());
}

}  // namespace
}  // namespace ode_ext
