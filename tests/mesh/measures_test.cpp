// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/measures.h"

#include <gtest/gtest.h>

#include "mesh/mesh.h"
#include "mesh/shapes.h"

namespace ode_ext {
namespace {

float vector_area_share_of(const TriangleSoup& soup) {
  const Mesh mesh = build_mesh(soup);
  return vector_area_share(mesh.vertices, mesh.topology->triangles);
}

TEST(Measures, FindNoVectorAreaOfWhatIsClosed) {
  EXPECT_NEAR(vector_area_share_of(shapes::cube()), 0, 1e-6);
  EXPECT_NEAR(vector_area_share_of(shapes::sphere(0.3, 12)), 0, 1e-6);
  EXPECT_NEAR(vector_area_share_of(shapes::torus(1, 0.3, 12)), 0, 1e-6);
}

TEST(Measures, FindAllOfTheAreaOfWhatIsFlat) {
  EXPECT_NEAR(vector_area_share_of(shapes::sheet(5)), 1, 1e-6);
  EXPECT_EQ(vector_area_share({}, {}), 1);
}

// Five sides of a cube: four of them against one another.
TEST(Measures, FindAFifthOfTheAreaOfABoxWithoutALid) {
  TriangleSoup open;
  const TriangleSoup cube = shapes::cube();
  for (std::size_t i = 0; i < cube.size(); i += 3)
    if (!(cube[i].z == 1 && cube[i + 1].z == 1 && cube[i + 2].z == 1))
      open.insert(open.end(), {cube[i], cube[i + 1], cube[i + 2]});
  EXPECT_NEAR(vector_area_share_of(open), 0.2, 1e-6);
}

}  // namespace
}  // namespace ode_ext
