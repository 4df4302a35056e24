// SPDX-License-Identifier: BSD-3-Clause
#include "view/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "meshes/shapes.h"
#include "view/shaded_mesh.h"

namespace view_tests {
namespace {

struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<unsigned> triangles;
};

Mesh torus() {
  const auto made = falling_objects::make_bumpy_torus();
  Mesh mesh;
  for (std::size_t i = 0; i < made.vertices.size(); i += 3) {
    mesh.positions.emplace_back(made.vertices[i], made.vertices[i + 1], made.vertices[i + 2]);
  }
  for (const auto index : made.indices) mesh.triangles.push_back(static_cast<unsigned>(index));
  return mesh;
}

TEST(Levels, HaveEverFewerTrianglesThatAreEverFartherOff) {
  const Mesh mesh = torus();
  const auto levels = view::levels_of(mesh.positions, mesh.triangles);
  ASSERT_GE(levels.size(), 3U);
  EXPECT_EQ(levels[0].triangles, mesh.triangles);
  EXPECT_EQ(levels[0].error, 0);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_LT(levels[i].triangles.size(),
              0.7 * static_cast<double>(levels[i - 1].triangles.size()));
    EXPECT_GE(levels[i].error, levels[i - 1].error);
    EXPECT_LT(levels[i].error, 0.15F);  // of what is a meter large
  }
}

TEST(Levels, OfNothingAreNothing) {
  const auto levels = view::levels_of({}, {});
  ASSERT_EQ(levels.size(), 1U);
  EXPECT_TRUE(levels[0].triangles.empty());
}

TEST(Border, IsOfTheEdgesThatHaveOneTriangle) {
  const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<unsigned> square{0, 1, 2, 0, 2, 3};
  EXPECT_EQ(view::border_of(corners, square).triangles.size(), 8U);
  const Mesh closed = torus();
  EXPECT_TRUE(view::border_of(closed.positions, closed.triangles).triangles.empty());
}

}  // namespace
}  // namespace view_tests
