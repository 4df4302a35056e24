// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/folded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "mesh/mesh.h"
#include "mesh/shapes.h"

namespace ode_ext {
namespace {

// A box, and so many pairs of triangles at one of its edges that cover one another, as high as
// given.
TriangleSoup box_with_folded(float height, int pairs) {
  TriangleSoup soup = shapes::box({0, 0, 0}, {20, 20, 2});
  const Vec3f a{0, 0, 2}, b{20, 0, 2}, c{7, 0, 2 + height};
  for (int i = 0; i < pairs; ++i) soup.insert(soup.end(), {a, b, c, b, a, c});
  return soup;
}

TEST(Folded, NeedlesLeaveASolidSolid) {
  for (const float height : {0.f, 2e-7f})
    for (const int pairs : {1, 2}) {
      const Mesh mesh = build_mesh(box_with_folded(height, pairs));
      EXPECT_TRUE(mesh.closed());
      EXPECT_EQ(mesh.topology->triangles.size(), 12u);
      EXPECT_EQ(mesh.vertices.size(), 8u);
    }
}

TEST(Folded, NeedlesStayWhereTheyAreHigherThanRounding) {
  const Mesh mesh = build_mesh(box_with_folded(1e-3f, 1));
  EXPECT_FALSE(mesh.closed());
  EXPECT_EQ(mesh.topology->triangles.size(), 14u);
}

// What has no other side holds its neighbours together.
TEST(Folded, NeedlesAreTwoAndTwo) {
  for (const int pairs : {1, 2}) {
    TriangleSoup soup = box_with_folded(0, pairs);
    soup.resize(soup.size() - 3);
    EXPECT_EQ(build_mesh(soup).topology->triangles.size(), 13u) << pairs;
  }
}

TEST(Folded, NeedlesAloneStay) {
  TriangleSoup soup = box_with_folded(0, 1);
  soup.erase(soup.begin(), soup.end() - 6);
  EXPECT_EQ(build_mesh(soup).topology->triangles.size(), 2u);
}

}  // namespace
}  // namespace ode_ext
