// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/convex.h"

#include <gtest/gtest.h>

#include "mesh/shapes.h"

namespace ode_ext {
namespace {

bool is_convex_soup(const TriangleSoup& soup, bool deformable = false) {
  MeshOptions options;
  options.deformable = deformable;
  return is_convex(build_mesh(soup, options));
}

TEST(Convex, AreBoxesAndBallsHoweverFineOrWhereverTheyLie) {
  for (const int steps : {1, 7}) {
    const TriangleSoup box = shapes::box({0, 0, 0}, {1, 2, 3}, steps);
    EXPECT_TRUE(is_convex_soup(box)) << steps;
    EXPECT_TRUE(is_convex_soup(shapes::turned(box))) << steps;
    EXPECT_TRUE(is_convex_soup(shapes::moved(box, 0.1f, {1000, 0, 3}))) << steps;
  }
  for (const int rows : {3, 8, 64}) EXPECT_TRUE(is_convex_soup(shapes::sphere(0.3, rows))) << rows;
  EXPECT_TRUE(is_convex_soup(shapes::tetrahedron()));
}

TEST(Convex, AreNoBodiesThatBendInwards) {
  EXPECT_FALSE(is_convex_soup(shapes::torus(1, 0.3, 16)));
  TriangleSoup dented = shapes::sphere(1, 12);
  const Vec3f corner = dented[dented.size() / 2];
  for (Vec3f& at : dented)
    if (at == corner) at = 0.9f * at;
  EXPECT_FALSE(is_convex_soup(dented));
}

TEST(Convex, AreNoBodiesOfTwoParts) {
  EXPECT_FALSE(is_convex_soup(
      shapes::joined(shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({2, 0, 0}, {3, 1, 1}))));
}

TEST(Convex, AreNoOpenMeshesNorThoseWhoseVerticesMove) {
  TriangleSoup open = shapes::cube();
  open.resize(open.size() - 3);
  EXPECT_FALSE(is_convex_soup(open));
  EXPECT_FALSE(is_convex_soup(shapes::sheet(3)));
  EXPECT_FALSE(is_convex_soup(shapes::cube(), true));
}

TEST(Convex, IsNothingOfNoTriangles) {
  EXPECT_FALSE(is_convex_soup({}));
  EXPECT_FALSE(is_convex(Mesh{}));
}

}  // namespace
}  // namespace ode_ext
