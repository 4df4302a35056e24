// SPDX-License-Identifier: BSD-3-Clause
#include "meshes/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/mesh_oracle.h"

namespace falling_objects {
namespace {

// Coordinates below 1 are rounded to float, by 2^-25 at most; sums of a few stay below this.
constexpr double kFloat = 1e-7;

TEST(Shapes, HaveTheTriangleCountsOfThePaper) {
  EXPECT_EQ(make_horseshoe().triangle_count(), 902u);
  EXPECT_EQ(make_bumpy_torus().triangle_count(), 2130u);
  EXPECT_EQ(make_jack().triangle_count(), 3264u);
  EXPECT_EQ(make_gear().triangle_count(), 3458u);
}

TEST(Shapes, AreClosedAndWoundOutwards) {
  for (const auto& [name, mesh] : make_shapes()) {
    EXPECT_TRUE(is_closed(mesh)) << name;
    EXPECT_GT(signed_volume(mesh), 0.01) << name;
  }
}

TEST(Shapes, EnclosePartOfTheirHullOnlyAndSoAreNotConvex) {
  for (const auto& [name, mesh] : make_shapes()) {
    // The middle of two vertices of a convex mesh is never outside.
    const ode_ext::oracle::Mesh oracle(mesh.vertices, mesh.indices);
    double farthest_out = 0;
    for (std::size_t i = 0; i < mesh.vertex_count(); i += 7) {
      for (std::size_t j = 0; j < mesh.vertex_count(); j += 11) {
        const Point a = mesh.vertex(i), b = mesh.vertex(j);
        const double distance =
            oracle.signed_distance({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
        farthest_out = std::max(farthest_out, distance);
      }
    }
    EXPECT_GT(farthest_out, 0.05) << name;
  }
}

TEST(Shapes, HaveNoTriangleWithoutArea) {
  // The smallest are those around the middle of the gear's sides: 1/546 of a disc of 8 cm, or less
  // by the shape of the tooth.
  for (const auto& [name, mesh] : make_shapes()) EXPECT_GT(smallest_area(mesh), 2e-5) << name;
}

TEST(Shapes, AreCentredOnTheirCentreOfMassAndOfOneSize) {
  for (const auto& [name, mesh] : make_shapes()) {
    const Point c = centre(mesh, true);
    EXPECT_LT(std::hypot(c[0], c[1], c[2]), kFloat) << name;
    EXPECT_NEAR(bounding_radius(mesh), kShapeRadius, kFloat) << name;
  }
}

TEST(Shapes, AreNowhereThinnerThan15Centimetres) {
  for (const auto& [name, mesh] : make_shapes()) {
    const ode_ext::oracle::Mesh oracle(mesh.vertices, mesh.indices);
    EXPECT_GT(oracle.thinnest_part(), 0.15) << name;
    EXPECT_LT(oracle.thinnest_part(), 0.3) << name;
  }
}

// A triangle across an axis has one coordinate that is the same, to the bit, at its three corners.
// Rounded shapes have next to none.
TEST(Shapes, HaveExactlyFlatFacesOnTheJackAndTheGear) {
  const auto flat_share = [](const TriangleMesh& mesh) {
    std::size_t flat = 0;
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
      const Corners c = mesh.corners(i);
      for (std::size_t k = 0; k < 3; ++k) flat += c[0][k] == c[1][k] && c[1][k] == c[2][k];
    }
    return static_cast<double>(flat) / static_cast<double>(mesh.triangle_count());
  };
  EXPECT_EQ(flat_share(make_jack()), 1);
  // The two sides: 2 * (91 + 2 * 91 * 5) of 3,458.
  EXPECT_GE(flat_share(make_gear()), 2002.0 / 3458);
  EXPECT_LT(flat_share(make_horseshoe()), 0.05);
  EXPECT_LT(flat_share(make_bumpy_torus()), 0.05);
}

TEST(TriangleMesh, IsOpenIfATriangleIsMissingOrTurned) {
  TriangleMesh mesh = make_horseshoe();
  std::swap(mesh.indices[0], mesh.indices[1]);
  EXPECT_FALSE(is_closed(mesh));
  mesh.indices.erase(mesh.indices.begin(), mesh.indices.begin() + 3);
  EXPECT_FALSE(is_closed(mesh));
}

TEST(TriangleMesh, IsInsideOutWithANegativeVolume) {
  TriangleMesh mesh = make_horseshoe();
  const double volume = signed_volume(mesh);
  turn_inside_out(mesh);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_DOUBLE_EQ(signed_volume(mesh), -volume);
}

TEST(TriangleMesh, WeldsALooseSoupToTheSameMesh) {
  const TriangleMesh mesh = make_horseshoe();
  TriangleMesh soup;
  for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
    const Corners c = mesh.corners(i);
    const unsigned first = soup.add_vertex(c[0]);
    soup.add_vertex(c[1]);
    soup.add_vertex(c[2]);
    soup.add_triangle(first, first + 1, first + 2);
  }
  soup.add_triangle(0, 1, 1);  // collapsed
  EXPECT_FALSE(is_closed(soup));
  weld(soup);
  EXPECT_TRUE(is_closed(soup));
  EXPECT_EQ(soup.vertex_count(), mesh.vertex_count());
  EXPECT_EQ(soup.triangle_count(), mesh.triangle_count());
}

}  // namespace
}  // namespace falling_objects
