// SPDX-License-Identifier: BSD-3-Clause
#include "reference/reference_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ode_ext::test {
namespace {

std::size_t count_of(const std::vector<ReferenceCrossing>& crossings, int side, bool leaves) {
  return static_cast<std::size_t>(
      std::count_if(crossings.begin(), crossings.end(),
                    [&](const auto& c) { return c.side == side && c.leaves == leaves; }));
}

TEST(ReferenceEdges, AreThoseOfACubeAndOfARoundMesh) {
  for (const int n : {1, 3})
    EXPECT_EQ(reference_edges(reference_mesh(make_cube(1, n))).size(),
              static_cast<std::size_t>(12 * n));
  EXPECT_EQ(reference_edges(reference_mesh(make_icosphere(1, 2))).size(), 480u);
  EXPECT_EQ(reference_edges(reference_mesh(make_sheet(1, 4))).size(), 16u);
  for (const ReferenceEdge& edge : reference_edges(reference_mesh(make_icosphere(1, 2))))
    EXPECT_FALSE(edge.doubtful);
}

// Three squares in a row, bent by 0.15 degrees and by 30.
TEST(ReferenceEdges, AreInDoubtWhereASurfaceHardlyBends) {
  TestMesh mesh;
  Point at{};
  for (const double bend : {0.0, 0.15, 30.0, 0.0}) {
    for (const double y : {0.0, 1.0})
      for (const double x : {at[0], y, at[2]}) mesh.vertices.push_back(static_cast<float>(x));
    const double radians = bend * std::acos(-1.0) / 180;
    at = at + Point{std::cos(radians), 0, std::sin(radians)};
  }
  for (unsigned i = 0; i < 6; i += 2)
    mesh.indices.insert(mesh.indices.end(), {i, i + 2, i + 3, i, i + 3, i + 1});
  const auto edges = reference_edges(reference_mesh(mesh));
  EXPECT_EQ(edges.size(), 13u);
  // The border and the sharp bend are not.
  EXPECT_EQ(std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.doubtful; }), 4);
}

// A square rod right through a plate, off the diagonals of its sides.
TEST(ReferenceCrossings, OfARodThroughAPlateEnterAndLeave) {
  const TestMesh rod = make_rod(2, 0.2), plate = make_box({1, 1, 0.1});
  const TestPose up = turned({0, 1, 0}, std::acos(-1.0) / 2, {0.13, 0.26, 0});
  const auto found = reference_crossings(rod, up, plate, at(0, 0, 0));
  ASSERT_EQ(found.size(), 8u);
  EXPECT_EQ(count_of(found, 0, false), 4u);
  EXPECT_EQ(count_of(found, 0, true), 4u);
  for (const ReferenceCrossing& c : found) {
    EXPECT_FALSE(c.ambiguous);
    EXPECT_LT(c.from, c.to);
    // From either end to the nearer side it is 0.95 m.
    EXPECT_NEAR(std::min(c.t, 2 - c.t), 0.95, 1e-6);
  }
}

TEST(ReferenceCrossings, OfWhatIsApartOrInsideAreNone) {
  const TestMesh cube = make_cube(1), small = make_cube(0.3);
  EXPECT_TRUE(reference_crossings(cube, at(1.01, 0, 0), cube, at(0, 0, 0)).empty());
  EXPECT_TRUE(reference_crossings(small, at(0.1, 0, 0), cube, at(0, 0, 0)).empty());
}

TEST(ReferenceCrossings, AreAmbiguousWhereTheyMayAsWellMiss) {
  const TestMesh cube = make_cube(1);
  // Edge on edge, edges in faces, and through the diagonal of a face.
  for (const Point& offset : {Point{1, 1, 0.3}, Point{1, 0.3, 0.2}, Point{0.6, 0.6, 0.3}}) {
    const auto found =
        reference_crossings(cube, at(offset[0], offset[1], offset[2]), cube, at(0, 0, 0));
    EXPECT_FALSE(found.empty());
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const auto& c) { return c.ambiguous; }));
  }
}

TEST(ReferenceCrossings, TurnRoundWithThePair) {
  Random random(5);
  const TestMesh a = make_l(1), b = make_icosphere(0.6, 1);
  const TestPose pa = random.pose(0.3), pb = random.pose(0.3);
  const auto one = reference_crossings(a, pa, b, pb), other = reference_crossings(b, pb, a, pa);
  ASSERT_GT(one.size(), 10u);
  for (const int side : {0, 1})
    for (const bool leaves : {false, true})
      EXPECT_EQ(count_of(one, side, leaves), count_of(other, 1 - side, leaves));
}

// By as much as its faces are farther out: the growth of a vertex along its normal, times the
// cosine between them.
TEST(ReferenceCrossings, MoveWithTheFirstMeshWhereItIsTakenToBeLarger) {
  const TestMesh cube = make_cube(1), rod = make_rod(2, 0.2);
  const ReferenceSurface a(cube), b(rod);
  const TestPose up = turned({0, 1, 0}, std::acos(-1.0) / 2, {0.13, 0.26, 0.9});
  const auto found = reference_crossings(a, {}, b, up, 1e-7);
  const auto moved = reference_crossings(a, {}, b, up, 1e-7, 0.01);
  ASSERT_EQ(found.size(), moved.size());
  ASSERT_EQ(count_of(found, 1, false), 4u);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].side == 0) continue;
    const double slant = distance(found[i].from, found[i].to) / 2;
    EXPECT_NEAR(std::fabs(moved[i].t - found[i].t), slant * 0.01 / std::sqrt(3.0), 1e-6);
  }
}

}  // namespace
}  // namespace ode_ext::test
