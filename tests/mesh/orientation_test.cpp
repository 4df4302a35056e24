// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/orientation.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "shapes.h"

namespace ode_ext {
namespace {

Mesh built_mesh(const TriangleSoup& soup) { return build_mesh(soup); }

TriangleSoup without_triangle(TriangleSoup soup, std::ptrdiff_t triangle) {
  soup.erase(soup.begin() + 3 * triangle, soup.begin() + 3 * triangle + 3);
  return soup;
}

TriangleSoup with_turned(TriangleSoup soup, std::size_t triangle) {
  std::swap(soup[3 * triangle], soup[3 * triangle + 2]);
  return soup;
}

TriangleSoup indexed(const std::vector<Vec3f>& places, const std::vector<Triangle>& triangles) {
  TriangleSoup soup;
  for (const Triangle& t : triangles) {
    shapes::append(soup, places[t[0]], places[t[1]], places[t[2]]);
  }
  return soup;
}

TEST(Orientation, FindsClosedMeshesClosed) {
  for (const TriangleSoup& soup :
       {shapes::tetrahedron(), shapes::cube(), shapes::sphere(1, 10), shapes::torus(1, 0.3, 12)}) {
    const Mesh mesh = built_mesh(soup);
    EXPECT_TRUE(mesh.closed());
    EXPECT_FALSE(mesh.topology->inverted);
    EXPECT_FALSE(mesh.topology->reoriented);
    EXPECT_GT(shapes::volume(mesh), 0);
  }
}

TEST(Orientation, FindsAMeshWithAHoleOpen) {
  for (std::ptrdiff_t hole = 0; hole < 12; ++hole) {
    EXPECT_FALSE(built_mesh(without_triangle(shapes::cube(), hole)).closed());
  }
  EXPECT_FALSE(built_mesh(shapes::sheet(4)).closed());
}

TEST(Orientation, TurnsAMeshOfNegativeVolume) {
  const Mesh mesh = built_mesh(shapes::turned(shapes::cube()));
  EXPECT_TRUE(mesh.closed());
  EXPECT_TRUE(mesh.topology->inverted);
  EXPECT_FALSE(mesh.topology->reoriented);
  EXPECT_DOUBLE_EQ(shapes::volume(mesh), 1);
}

TEST(Orientation, TurnsASmallMeshFarFromTheOrigin) {
  for (const float offset : {1e6f, 1.7e6f, 3.1e6f, 7.9e6f}) {
    const TriangleSoup far =
        shapes::moved(shapes::sphere(1, 12), 4, {offset, -1.3f * offset, 0.7f * offset});
    EXPECT_FALSE(built_mesh(far).topology->inverted);
    EXPECT_TRUE(built_mesh(shapes::turned(far)).topology->inverted);
  }
}

TEST(Orientation, MakesAnInconsistentWindingConsistent) {
  for (std::size_t triangle = 0; triangle < 12; ++triangle) {
    const Mesh mesh = built_mesh(with_turned(shapes::cube(), triangle));
    EXPECT_TRUE(mesh.closed());
    EXPECT_TRUE(mesh.topology->reoriented);
    EXPECT_FALSE(mesh.topology->inverted);
    EXPECT_DOUBLE_EQ(shapes::volume(mesh), 1);
  }
}

TEST(Orientation, GivesEachPartOfAnInconsistentMeshAPositiveVolume) {
  const TriangleSoup other = shapes::turned(shapes::box({5, 0, 0}, {6, 2, 1}));
  const Mesh mesh = built_mesh(shapes::joined(with_turned(shapes::cube(), 3), other));
  EXPECT_TRUE(mesh.closed());
  EXPECT_TRUE(mesh.topology->reoriented);
  EXPECT_DOUBLE_EQ(shapes::volume(mesh), 3);
}

// By the volume of each part, of which rounding must not be more.
TEST(Orientation, TurnsSmallPartsOfALargeMeshOutward) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-500, 500), corner(0, 0.002f);
  std::vector<TriangleSoup> parts;
  TriangleSoup all;
  while (parts.size() < 1000) {
    const Vec3f at{place(random), place(random), place(random)};
    std::array<Vec3f, 4> p;
    for (Vec3f& v : p) v = at + Vec3f{corner(random), corner(random), corner(random)};
    const Vec3d u(p[1] - p[0]), v(p[2] - p[0]), w(p[3] - p[0]);
    const double volume = dot(u, cross(v, w));
    if (std::abs(volume) < 0.05 * length(u) * length(v) * length(w)) continue;  // hardly a solid
    if (volume < 0) std::swap(p[1], p[2]);
    // One of four triangles is turned: each part is to be decided by itself.
    parts.push_back({p[0], p[1], p[2], p[0], p[1], p[3], p[1], p[2], p[3], p[2], p[0], p[3]});
    all = parts.size() == 1 ? parts[0] : shapes::joined(all, parts.back());
  }
  const Mesh mesh = built_mesh(all);
  ASSERT_TRUE(mesh.topology->reoriented);
  std::map<std::uint32_t, double> volumes;  // by part
  std::map<std::uint32_t, Vec3d> apexes;
  for (std::size_t t = 0; t < mesh.topology->triangles.size(); ++t) {
    const std::uint32_t part = mesh.topology->source_triangle[t] / 4;
    const auto& corners = mesh.topology->triangles[t];
    const Vec3d apex = apexes.emplace(part, Vec3d(mesh.vertices[corners[0]])).first->second;
    volumes[part] += dot(
        Vec3d(mesh.vertices[corners[0]]) - apex,
        cross(Vec3d(mesh.vertices[corners[1]]) - apex, Vec3d(mesh.vertices[corners[2]]) - apex));
  }
  ASSERT_EQ(volumes.size(), parts.size());
  for (const auto& [part, volume] : volumes) EXPECT_GT(volume, 0) << part;
}

TEST(Orientation, LeavesACavityACavity) {
  const TriangleSoup cavity =
      shapes::turned(shapes::box({0.25f, 0.25f, 0.25f}, {0.75f, 0.75f, 0.75f}));
  const TriangleSoup hollow = shapes::joined(shapes::cube(), cavity);
  for (const bool turned : {false, true}) {
    const Mesh mesh = built_mesh(turned ? shapes::turned(hollow) : hollow);
    EXPECT_TRUE(mesh.closed());
    EXPECT_FALSE(mesh.topology->reoriented);
    EXPECT_EQ(mesh.topology->inverted, turned);
    EXPECT_DOUBLE_EQ(shapes::volume(mesh), 0.875);
  }
}

TEST(Orientation, ClosesMeshesThatShareAnEdge) {
  const TriangleSoup two = shapes::joined(shapes::cube(), shapes::box({1, 1, 0}, {2, 2, 1}));
  for (const bool turned : {false, true}) {
    const Mesh mesh = built_mesh(turned ? shapes::turned(two) : two);
    EXPECT_EQ(mesh.vertices.size(), 14u);
    EXPECT_TRUE(mesh.closed());
    EXPECT_EQ(mesh.topology->inverted, turned);
    EXPECT_DOUBLE_EQ(shapes::volume(mesh), 2);
  }
}

// Of four triangles at an edge it is not known which two are neighbours.
TEST(Orientation, FindsMeshesThatShareAnEdgeAndContradictThemselvesOpen) {
  const TriangleSoup two = shapes::joined(shapes::cube(), shapes::box({1, 1, 0}, {2, 2, 1}));
  for (std::size_t triangle = 0; triangle < 24; ++triangle)
    EXPECT_FALSE(built_mesh(with_turned(two, triangle)).closed());
}

TEST(Orientation, FindsAnEdgeOfThreeTrianglesOpen) {
  TriangleSoup fin = shapes::cube();
  shapes::append(fin, {0, 0, 0}, {1, 0, 0}, {0, -1, -1});
  EXPECT_FALSE(built_mesh(fin).closed());
}

TEST(Orientation, ClosesMeshesThatShareOnlyAVertex) {
  const Mesh mesh = built_mesh(shapes::joined(shapes::cube(), shapes::box({1, 1, 1}, {2, 2, 2})));
  EXPECT_EQ(mesh.vertices.size(), 15u);
  EXPECT_TRUE(mesh.closed());
}

TEST(Orientation, KeepsDuplicateTrianglesAndFindsTheMeshOpen) {
  const TriangleSoup cube = shapes::cube();
  TriangleSoup soup = cube;
  shapes::append(soup, cube[0], cube[1], cube[2]);
  const Mesh mesh = built_mesh(soup);
  EXPECT_EQ(mesh.topology->triangles.size(), 13u);
  EXPECT_FALSE(mesh.closed());
  EXPECT_FALSE(built_mesh(shapes::joined(cube, cube)).closed());
}

TEST(Orientation, FindsATriangleOfTwoSidesOpen) {
  const Vec3f a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_FALSE(built_mesh({a, b, c, a, c, b}).closed());
}

TEST(Orientation, CountsSliversAsNeighbours) {
  // The bottom of a tetrahedron cut at a corner on its edge, the gap filled by a sliver.
  const Vec3f o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, m{0.5f, 0, 0};
  const TriangleSoup soup{o, y, m, m, y, x, o, m, x, o, x, z, o, z, y, x, y, z};
  const Mesh mesh = built_mesh(soup);
  EXPECT_EQ(mesh.topology->triangles.size(), 6u);
  EXPECT_TRUE(mesh.closed());
  int without_area = 0;
  for (std::uint32_t t = 0; t < 6; ++t) without_area += face_normal(mesh, t) == Vec3d{};
  EXPECT_EQ(without_area, 1);
}

TEST(Orientation, LeavesASurfaceWithoutSidesAlone) {
  // The projective plane on six places: each of its 15 edges has two of its ten triangles.
  const std::vector<Vec3f> places{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 2}, {2, 1, 1}};
  const TriangleSoup soup = indexed(places, {{0, 1, 2},
                                             {0, 2, 3},
                                             {0, 3, 4},
                                             {0, 4, 5},
                                             {0, 1, 5},
                                             {1, 2, 4},
                                             {2, 3, 5},
                                             {1, 3, 4},
                                             {2, 4, 5},
                                             {1, 3, 5}});
  const Mesh mesh = built_mesh(soup);
  EXPECT_FALSE(mesh.closed());
  EXPECT_FALSE(mesh.topology->reoriented);
  for (std::size_t i = 0; i < mesh.topology->triangles.size(); ++i) {
    EXPECT_TRUE(shapes::is_triangle_of(soup, mesh.topology->source_triangle[i], mesh,
                                       mesh.topology->triangles[i]));
  }
}

RC_GTEST_PROP(OrientationProperty, UndoesAnyTurnedTriangles, ()) {
  static const TriangleSoup torus = shapes::torus(1, 0.3, 4);
  static const double expected = shapes::volume(built_mesh(torus));
  TriangleSoup soup = torus;
  const auto turned =
      *rc::gen::container<std::vector<bool>>(soup.size() / 3, rc::gen::arbitrary<bool>());
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (turned[i]) soup = with_turned(std::move(soup), i);
  }
  const Mesh mesh = built_mesh(soup);
  RC_ASSERT(mesh.closed());
  RC_ASSERT(std::fabs(shapes::volume(mesh) - expected) < 1e-12);
  for (std::size_t i = 0; i < mesh.topology->triangles.size(); ++i) {
    const std::size_t source = 3 * mesh.topology->source_triangle[i];
    for (const std::uint32_t corner : mesh.topology->triangles[i]) {
      const Vec3f place = mesh.vertices[corner];
      RC_ASSERT(place == soup[source] || place == soup[source + 1] || place == soup[source + 2]);
    }
  }
}

}  // namespace
}  // namespace ode_ext
