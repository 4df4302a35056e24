// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/clearance_grid.h"

#include <gtest/gtest.h>

#include <random>

#include "shapes.h"

namespace ode_ext {
namespace {

float clearance_at(const Mesh& mesh, Vec3f point) {
  return clearance(mesh.clearance, mesh.grid, point);
}

TEST(ClearanceGrid, HoldsNothingThatMayBeInside) {
  std::mt19937 random(51);
  std::uniform_real_distribution<float> part(-0.5f, 1.5f), sign(-1, 1);
  for (const TriangleSoup& soup :
       {shapes::torus(1, 0.1, 24), shapes::tetrahedron(),
        shapes::moved(shapes::torus(1, 0.1, 16), 10, {1e5f, -1e5f, 0})}) {
    const Mesh mesh = build_mesh(soup);
    const Vec3f size = mesh.box.hi - mesh.box.lo;
    int cleared = 0;
    for (int i = 0; i < 20000; ++i) {
      Vec3f point;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        point[axis] = mesh.box.lo[axis] + part(random) * size[axis];
      }
      const float radius = clearance_at(mesh, point);
      if (radius <= 0) continue;
      ++cleared;
      Vec3f step{sign(random), sign(random), sign(random)};
      step = (0.999f * radius / length(step)) * step;
      ASSERT_FALSE(may_be_inside(mesh.grid, point + step));
      ASSERT_FALSE(may_be_inside(mesh.grid, point));
    }
    EXPECT_GT(cleared, 100);
  }
}

TEST(ClearanceGrid, IsNotPositiveOnTheMesh) {
  const Mesh mesh = build_mesh(shapes::torus(1, 0.3, 16));
  for (const Vec3f& vertex : mesh.vertices) EXPECT_LE(clearance_at(mesh, vertex), 0);
}

TEST(ClearanceGrid, ClearsTheHoleOfATorus) {
  // The tube begins 0.9 m from the middle; the distance is known to a block or two.
  const Mesh mesh = build_mesh(shapes::torus(1, 0.1, 24));
  EXPECT_GT(clearance_at(mesh, {0, 0, 0}), 0.4f);
  EXPECT_LT(clearance_at(mesh, {0, 0, 0}), 0.9f);
}

TEST(ClearanceGrid, IsOnlyThereWithAnOccupancyGrid) {
  const Mesh open = build_mesh(shapes::sheet(3));
  const Mesh without = build_mesh(shapes::cube(), {.occupancy_grid = false});
  for (const Mesh* mesh : {&open, &without}) {
    EXPECT_EQ(mesh->grid.cells[0], 0u);
    EXPECT_TRUE(mesh->clearance.steps.empty());
    EXPECT_EQ(clearance_at(*mesh, {9, 9, 9}), 0);
  }
}

}  // namespace
}  // namespace ode_ext
