// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/deform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <tuple>
#include <vector>

#include "shapes.h"
#include "support/deformed.h"

namespace ode_ext {
namespace {

using test::deformed;
using Shape = std::shared_ptr<const Mesh>;

Shape built(const TriangleSoup& soup, float open_thickness = 0) {
  return std::make_shared<const Mesh>(
      build_mesh(soup, {.open_thickness = open_thickness, .deformable = true}));
}

// Every place to another one, no two to the same.
TriangleSoup bent(TriangleSoup soup) {
  for (Vec3f& p : soup)
    p = {p.x + 0.125f * std::sin(3 * p.y), p.y + 0.125f * std::cos(2 * p.z), p.z + 0.25f * p.x};
  return soup;
}

TEST(Deformed, MovesTheVerticesAndKeepsTheTopology) {
  const TriangleSoup soup = shapes::torus(1, 0.3, 16), target = bent(soup);
  const Shape base = built(soup), shape = deformed(base, target);
  ASSERT_NE(shape, nullptr);
  EXPECT_EQ(shape->topology, base->topology);
  ASSERT_EQ(shape->vertices.size(), base->vertices.size());
  for (std::size_t t = 0; t < base->topology->triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(shape->vertices[base->topology->triangles[t][k]],
                target[3 * base->topology->source_triangle[t] + k]);
}

// A sheet of 4 m, flat, or rolled up so that sixteen layers lie on one another.
TriangleSoup sheet_of_four_metres(bool rolled) {
  TriangleSoup soup;
  const auto at = [&](int i, int j) {
    const float s = 4.0f * static_cast<float>(i) / 64, y = static_cast<float>(j) / 16;
    const float turn = 8 * std::numbers::pi_v<float> * s, r = 0.02f + 0.0005f * s;
    return rolled ? Vec3f{r * std::cos(turn), y, r * std::sin(turn)} : Vec3f{s, y, 0};
  };
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 16; ++j) {
      shapes::append(soup, at(i, j), at(i + 1, j), at(i, j + 1));
      shapes::append(soup, at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return soup;
}

TEST(Deformed, IsBuiltAnewWhereTrianglesThatLaySideBySideNoLongerDo) {
  const TriangleSoup flat = sheet_of_four_metres(false), rolled = sheet_of_four_metres(true);
  EXPECT_EQ(deformed(built(rolled), flat), nullptr);
  // What lay side by side stays so, however it is rolled.
  const Shape shape = deformed(built(flat), rolled);
  ASSERT_NE(shape, nullptr);
  EXPECT_NE(deformed(shape, flat), nullptr);
}

// All but the order of the vertices is as if the mesh had been built in this shape.
TEST(Deformed, MeasuresAsABuiltMeshDoes) {
  for (const TriangleSoup& soup :
       {shapes::torus(1, 0.3, 16), shapes::sheet(9), shapes::sphere(1, 8), shapes::cube()}) {
    const Shape shape = deformed(built(soup, 0.5f), bent(soup)), fresh = built(bent(soup), 0.5f);
    ASSERT_NE(shape, nullptr);
    EXPECT_TRUE(shape->finite && shape->deformable && fresh->deformable);
    EXPECT_EQ(shape->closed(), fresh->closed());
    EXPECT_EQ(shape->topology->inverted, fresh->topology->inverted);
    EXPECT_EQ(shape->box.lo, fresh->box.lo);
    EXPECT_EQ(shape->box.hi, fresh->box.hi);
    EXPECT_EQ(shape->radius, fresh->radius);
    EXPECT_EQ(shape->mean_edge, fresh->mean_edge);
    EXPECT_EQ(shape->open_thickness, fresh->open_thickness);
    EXPECT_EQ(shape->content_hash, fresh->content_hash);
    for (const Vec3f& vertex : shape->vertices)
      EXPECT_LE(length(Vec3d(vertex) - Vec3d(centre(shape->box))), shape->radius);
    const auto before = [](const Vec3f& a, const Vec3f& b) {
      return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::vector<Vec3f> ours = shape->vertices, theirs = fresh->vertices;
    std::sort(ours.begin(), ours.end(), before);
    std::sort(theirs.begin(), theirs.end(), before);
    EXPECT_EQ(ours, theirs);
    for (std::uint32_t t = 0; t < fresh->topology->triangles.size(); ++t)
      EXPECT_EQ(face_normal(*shape, t), face_normal(*fresh, t));
  }
}

TEST(Deformed, GivesTheNormalOfAFaceAsItLiesNow) {
  const TriangleSoup flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
      upright{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Shape base = built(flat), shape = deformed(base, upright);
  EXPECT_EQ(face_normal(*base, 0), (Vec3d{0, 0, 1}));
  EXPECT_EQ(face_normal(*shape, 0), (Vec3d{1, 0, 0}));
}

TEST(Deformed, RefusesAnotherNumberOfTriangles) {
  const TriangleSoup soup = shapes::sheet(4);
  TriangleSoup fewer = soup, more = soup;
  fewer.resize(soup.size() - 3);
  more.insert(more.end(), soup.begin(), soup.begin() + 3);
  const Shape base = built(soup);
  EXPECT_NE(deformed(base, soup), nullptr);
  EXPECT_EQ(deformed(base, fewer), nullptr);
  EXPECT_EQ(deformed(base, more), nullptr);
  EXPECT_EQ(deformed(base, {}), nullptr);
  EXPECT_EQ(deformed(built({}), soup), nullptr);
}

TEST(Deformed, RefusesAVertexTornApartByOneBit) {
  const TriangleSoup soup = shapes::sheet(4);
  const Shape base = built(soup);
  int torn = 0;
  for (std::size_t i = 0; i < soup.size(); ++i) {
    const bool shared = std::count(soup.begin(), soup.end(), soup[i]) > 1;
    TriangleSoup changed = soup;
    changed[i].y = std::nextafter(changed[i].y, 9.0f);
    EXPECT_EQ(deformed(base, changed) == nullptr, shared) << i;
    torn += shared;
  }
  EXPECT_GT(torn, 80);
}

TEST(Deformed, TakesNegativeZeroForZero) {
  TriangleSoup soup = shapes::sheet(2), signs = soup;
  for (std::size_t i = 0; i < signs.size(); i += 2) signs[i].z = -0.0f;
  const Shape shape = deformed(built(soup), signs);
  ASSERT_NE(shape, nullptr);
  for (const Vec3f& vertex : shape->vertices) EXPECT_FALSE(std::signbit(vertex.z));
  EXPECT_NE(deformed(built(signs), soup), nullptr);
}

TEST(Deformed, RefusesTrianglesGivenOtherCorners) {
  const TriangleSoup soup = shapes::sheet(3);
  TriangleSoup turned = soup, swapped = soup;
  std::swap(turned[1], turned[2]);
  std::swap_ranges(swapped.begin(), swapped.begin() + 3, swapped.begin() + 9);
  EXPECT_EQ(deformed(built(soup), turned), nullptr);
  EXPECT_EQ(deformed(built(soup), swapped), nullptr);
}

TEST(Deformed, RefusesATriangleThatVanishesOrAppears) {
  // The last triangle hangs on nothing else, so that nothing is torn where it collapses.
  TriangleSoup whole = shapes::sheet(3), collapsed;
  shapes::append(whole, {5, 0, 0}, {6, 0, 0}, {5, 1, 0});
  collapsed = whole;
  collapsed.back() = collapsed[collapsed.size() - 2];
  EXPECT_EQ(deformed(built(whole), collapsed), nullptr);
  EXPECT_EQ(deformed(built(collapsed), whole), nullptr);
  EXPECT_NE(deformed(built(collapsed), bent(collapsed)), nullptr);
}

TEST(Deformed, KeepsCollapsedTrianglesOutEvenWhereTheyMove) {
  const TriangleSoup sphere = shapes::sphere(1, 6);  // collapsed at the poles
  const Shape base = built(sphere), shape = deformed(base, bent(sphere));
  ASSERT_NE(shape, nullptr);
  EXPECT_LT(base->topology->triangles.size(), sphere.size() / 3);
}

TEST(Deformed, RefusesVerticesThatCameTogether) {
  const TriangleSoup apart{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
  TriangleSoup together = apart, near = apart;
  together[3] = together[0];
  near[3] = {std::numeric_limits<float>::denorm_min(), 0, 0};
  EXPECT_EQ(deformed(built(apart), together), nullptr);
  EXPECT_NE(deformed(built(apart), near), nullptr);
  EXPECT_NE(deformed(built(together), together), nullptr);
}

TEST(Deformed, HasTheEdgesOfAMeshBuiltInItsShape) {
  for (const TriangleSoup& soup :
       {shapes::torus(1, 0.3, 16), shapes::sheet(9), shapes::sphere(1, 8), shapes::cube()}) {
    TriangleSoup turned = bent(soup);  // half a turn about z
    for (Vec3f& p : turned) p = {-p.x, -p.y, p.z};
    const Shape shape = deformed(built(soup), turned), fresh = built(turned);
    ASSERT_NE(shape, nullptr);
    const std::vector<Edge>&ours = shape->topology->edges, &theirs = fresh->topology->edges;
    ASSERT_EQ(ours.size(), theirs.size());
    for (std::size_t i = 0; i < ours.size(); ++i) {
      EXPECT_EQ(ours[i].vertices, theirs[i].vertices);
      EXPECT_EQ(ours[i].triangles, theirs[i].triangles);
    }
  }
}

TEST(Deformed, RefusesAClosedMeshTurnedInsideOut) {
  const TriangleSoup soup = shapes::torus(1, 0.3, 8);
  TriangleSoup mirrored = soup;
  for (Vec3f& p : mirrored) p.x = -p.x;
  EXPECT_EQ(deformed(built(soup), mirrored), nullptr);
  EXPECT_EQ(deformed(built(mirrored), soup), nullptr);
  EXPECT_NE(deformed(built(mirrored), bent(mirrored)), nullptr);
  const TriangleSoup sheet = shapes::sheet(3);
  TriangleSoup turned = sheet;
  for (Vec3f& p : turned) p.x = -p.x;
  EXPECT_NE(deformed(built(sheet), turned), nullptr);  // open: has no inside
}

TEST(Deformed, RefusesAMeshWhoseWindingsWereMadeConsistent) {
  TriangleSoup soup = shapes::cube();
  std::swap(soup[1], soup[2]);
  const Shape base = built(soup);
  ASSERT_TRUE(base->closed() && base->topology->reoriented);
  EXPECT_EQ(deformed(base, soup), nullptr);
}

TEST(Deformed, ThatIsNotFiniteIsEmptyAsIfBuilt) {
  const TriangleSoup soup = shapes::cube();
  const Shape base = built(soup);
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    TriangleSoup broken = soup;
    broken[7].y = bad;
    const Shape shape = deformed(base, broken);
    ASSERT_NE(shape, nullptr);
    EXPECT_FALSE(shape->finite);
    EXPECT_TRUE(shape->vertices.empty() && shape->topology->triangles.empty());
    EXPECT_EQ(shape->content_hash, built(broken)->content_hash);
    EXPECT_EQ(deformed(shape, soup), nullptr);
    EXPECT_NE(deformed(base, soup), nullptr);
  }
}

}  // namespace
}  // namespace ode_ext
