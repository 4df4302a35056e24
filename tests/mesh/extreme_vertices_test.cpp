// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/extreme_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "mesh/mesh.h"
#include "support/convex_makers.h"
#include "support/fcl_oracle.h"
#include "support/test_scene.h"

namespace ode_ext {
namespace {

using test::TestMesh;

Vec3d place_at(const Mesh& mesh, std::uint32_t vertex) { return Vec3d(mesh.vertices[vertex]); }

Mesh built(const TestMesh& mesh) { return build_mesh(test::soup_of(mesh)); }

// The ways to the neighbours of each vertex, and the facets there.
struct About {
  std::vector<Vec3d> ways;
  std::set<std::uint32_t> facets;
  double nearest = INFINITY;
};

std::vector<About> about_vertices(const Mesh& mesh) {
  std::vector<About> result(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.topology->triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.topology->triangles[t][k];
      const std::uint32_t w = mesh.topology->triangles[t][(k + 1) % 3];
      About& about = result[v];
      const Vec3d way = place_at(mesh, w) - place_at(mesh, v);
      about.ways.push_back((1 / length(way)) * way);
      about.nearest = std::min(about.nearest, length(way));
      about.facets.insert(mesh.topology->facets[t]);
    }
  return result;
}

// Whether a point is within the hull of four of the ways (Caratheodory): then no plane has all of
// them on one side.
bool surround(const std::vector<Vec3d>& w) {
  const auto det = [](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return dot(a, cross(b, c));
  };
  for (std::size_t a = 0; a < w.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (std::size_t c = 0; c < b; ++c)
        for (std::size_t d = 0; d < c; ++d) {
          const double parts[] = {det(w[b], w[c], w[d]), -det(w[a], w[c], w[d]),
                                  det(w[a], w[b], w[d]), -det(w[a], w[b], w[c])};
          const auto [least, most] = std::minmax_element(std::begin(parts), std::end(parts));
          if (*least > 1e-9 || *most < -1e-9) return true;
        }
  return false;
}

// Whether the solid is where a vertex would go along a direction.
bool is_solid_along(const TestMesh& mesh, const Mesh& made, const About& about, std::uint32_t v,
                    const Vec3d& direction) {
  const Vec3d p = place_at(made, v) + (1e-4 * about.nearest) * direction;
  return std::abs(test::winding_number(mesh, {p.x, p.y, p.z})) > 0.5;
}

// Evenly spread directions (a spiral).
std::vector<Vec3d> directions(int count) {
  std::vector<Vec3d> result;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z), turn = 2.399963 * i;
    result.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  return result;
}

// Closed, about the origin.
std::vector<TestMesh> solids() {
  TestMesh dented = test::make_icosphere(0.5, 3);
  for (std::size_t i = 0; i + 2 < dented.vertices.size(); i += 3) {
    const float x = dented.vertices[i], y = dented.vertices[i + 1], z = dented.vertices[i + 2];
    const float by = 1 + 0.1f * std::sin(9 * x + 1) * std::sin(8 * y) * std::cos(7 * z);
    for (std::size_t k = 0; k < 3; ++k) dented.vertices[i + k] *= by;
  }
  return {dented,
          test::make_torus(0.4, 0.15, 24, 12),
          test::make_l(0.5),
          test::make_cube(1, 3),
          test::make_comb(4, 1, 0.5, 0.25),
          test::make_cylinder(0.3, 1, 17),
          test::make_icosphere(0.5, 2)};
}

TEST(ExtremeVertices, AreNoneThatTheirNeighboursSurround) {
  int surrounded = 0;
  for (const TestMesh& solid : solids()) {
    const Mesh mesh = built(solid);
    const std::vector<About> about = about_vertices(mesh);
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
      if (!surround(about[v].ways)) continue;
      ++surrounded;
      EXPECT_EQ(mesh.extreme[v], 0) << "vertex " << v;
    }
  }
  EXPECT_GT(surrounded, 150);
}

TEST(ExtremeVertices, AreAllThatReachFartherThanTheirNeighbours) {
  const std::vector<Vec3d> ways = directions(2000);
  int reaching = 0;
  for (const TestMesh& solid : solids()) {
    const Mesh mesh = built(solid);
    const std::vector<About> about = about_vertices(mesh);
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
      const auto reaches = [&](const Vec3d& way) {
        return std::all_of(about[v].ways.begin(), about[v].ways.end(),
                           [&](const Vec3d& to) { return dot(to, way) < -1e-6; });
      };
      const auto way = std::find_if(ways.begin(), ways.end(), reaches);
      if (way == ways.end() || is_solid_along(solid, mesh, about[v], v, *way)) continue;
      ++reaching;
      EXPECT_EQ(mesh.extreme[v], about[v].facets.size() > 1 ? 1 : 0) << "vertex " << v;
    }
  }
  EXPECT_GT(reaching, 400);
}

// What is left out is left out for a reason that an oracle confirms.
TEST(ExtremeVertices, AreAllButThoseSurroundedOrInAPitOrWithinAFacet) {
  int surrounded = 0, pits = 0, flat = 0;
  for (const TestMesh& solid : solids()) {
    const Mesh mesh = built(solid);
    const std::vector<About> about = about_vertices(mesh);
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
      if (mesh.extreme[v] != 0) continue;
      Vec3d sum{};
      for (const Vec3d& way : about[v].ways) sum = sum + way;
      if (about[v].facets.size() == 1) {
        ++flat;
      } else if (surround(about[v].ways)) {
        ++surrounded;
      } else {
        ++pits;
        EXPECT_TRUE(is_solid_along(solid, mesh, about[v], v, (-1 / length(sum)) * sum))
            << "vertex " << v;
      }
    }
  }
  EXPECT_GT(surrounded, 150);
  EXPECT_GT(pits, 20);
  EXPECT_GT(flat, 20);
}

TEST(ExtremeVertices, AreAllOfAConvexSolidWithoutFacets) {
  const Mesh mesh = built(test::make_icosphere(0.5, 3));
  EXPECT_EQ(std::count(mesh.extreme.begin(), mesh.extreme.end(), 1),
            static_cast<std::ptrdiff_t>(mesh.vertices.size()));
}

// Between two facets a vertex may be of a straight edge: it is as far out as the edge's ends.
TEST(ExtremeVertices, AreThoseOfAStraightRidgeToo) {
  const Mesh mesh = built(test::make_cube(1, 4));
  const std::vector<About> about = about_vertices(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    EXPECT_EQ(mesh.extreme[v], about[v].facets.size() > 1 ? 1 : 0);
}

// Nothing is known there: the surface ends, or it does not say which side is the solid's.
TEST(ExtremeVertices, AreThoseAtABorder) {
  const Mesh mesh = built(test::make_waves(1, 8));
  std::set<std::uint32_t> border;
  for (const Edge& edge : mesh.topology->edges)
    if (edge.triangles[1] == kNone) border.insert(edge.vertices.begin(), edge.vertices.end());
  ASSERT_EQ(border.size(), 32u);
  for (const std::uint32_t v : border) EXPECT_EQ(mesh.extreme[v], 1);
  EXPECT_GT(std::count(mesh.extreme.begin(), mesh.extreme.end(), 0), 20);
}

TEST(ExtremeVertices, AreThoseThatTwoSolidsShare) {
  // Corner to corner.
  TestMesh both = test::make_cube(1);
  const TestMesh other = test::moved(test::make_cube(1), {1, 1, 1});
  const auto first = static_cast<unsigned>(both.vertices.size() / 3);
  both.vertices.insert(both.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const unsigned i : other.indices) both.indices.push_back(first + i);
  const Mesh mesh = built(both);
  ASSERT_EQ(mesh.vertices.size(), 15u);
  EXPECT_EQ(std::count(mesh.extreme.begin(), mesh.extreme.end(), 1), 15);
}

TEST(ExtremeVertices, AreTheSameOfAMeshTurnedInsideOut) {
  for (const TestMesh& solid : solids()) {
    TestMesh turned = solid;
    for (std::size_t i = 0; i + 2 < turned.indices.size(); i += 3)
      std::swap(turned.indices[i], turned.indices[i + 1]);
    EXPECT_EQ(built(turned).extreme, built(solid).extreme);
  }
}

// Of a spike with hundreds of sides it is not looked at whether it is one, or a pit.
TEST(ExtremeVertices, AreThoseOfHundredsOfTrianglesButWithinAFacet) {
  const Mesh mesh = built(test::make_cone(0.5, 1, 300));
  const std::vector<About> about = about_vertices(mesh);
  int crowded = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    crowded += about[v].ways.size() == 300 ? 1 : 0;
    EXPECT_EQ(mesh.extreme[v], about[v].facets.size() > 1 ? 1 : 0);
  }
  EXPECT_EQ(crowded, 2);
}

TEST(ExtremeVertices, AreNotAskedForOfDeformableMeshes) {
  MeshOptions options;
  options.deformable = true;
  EXPECT_TRUE(build_mesh(test::soup_of(test::make_icosphere(0.5, 1)), options).extreme.empty());
}

}  // namespace
}  // namespace ode_ext
