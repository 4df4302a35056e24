// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/clearance_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/triangle_distance.h"
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

double distance_to(const Mesh& mesh, Vec3f point) {
  double least = INFINITY;
  for (const Triangle& t : mesh.triangles)
    least = std::min(least, squared_distance(Vec3d(point), {Vec3d(mesh.vertices[t[0]]),
                                                            Vec3d(mesh.vertices[t[1]]),
                                                            Vec3d(mesh.vertices[t[2]])}));
  return std::sqrt(least);
}

// Cells of the occupancy grid are known as a whole, and blocks by their centres.
TEST(ClearanceGrid, IsNeverMoreThanTheDistanceAndInTheGridLessByTwoBlocksAtMost) {
  std::mt19937 random(52);
  std::uniform_real_distribution<float> part(-0.5f, 1.5f);
  for (const TriangleSoup& soup :
       {shapes::torus(1, 0.3, 16), shapes::sphere(1, 12), shapes::sheet(5), shapes::tetrahedron(),
        shapes::box({0, 0, 0}, {4, 4, 0.1f}, 6),
        shapes::moved(shapes::torus(1, 0.3, 12), 10, {1e4f, -1e4f, 0})}) {
    const Mesh mesh = build_mesh(soup);
    const Vec3f size = mesh.box.hi - mesh.box.lo;
    double block = 0;  // diagonal
    for (std::size_t axis = 0; axis < 3; ++axis)
      block += std::pow(kBlockCells / double{mesh.grid.cells_per_meter[axis]}, 2);
    block = std::sqrt(block);
    // A byte holds so much, and rounding is of the size of the coordinates.
    const double most = 127 * double{mesh.clearance.step} - block;
    const double rounding = 1e-6 * double{length(max(mesh.box.hi, Vec3f{} - mesh.box.lo))};
    for (int i = 0; i < 2000; ++i) {
      Vec3f point;
      for (std::size_t axis = 0; axis < 3; ++axis)
        point[axis] = mesh.box.lo[axis] + part(random) * (size[axis] + 0.3f);
      const double known = std::fabs(clearance_at(mesh, point));
      const double distance = distance_to(mesh, point);
      EXPECT_LE(known, distance + rounding);
      const bool within = min(max(point, mesh.box.lo), mesh.box.hi) == point;
      EXPECT_TRUE(!within || known >= std::min(most, distance) - 2 * block);
    }
  }
}

TEST(ClearanceGrid, IsPositiveOutsideOnly) {
  const Mesh mesh = build_mesh(shapes::sphere(1, 24));
  for (const float inside : {0.0f, 0.3f, 0.6f}) EXPECT_LT(clearance_at(mesh, {inside, 0, 0}), 0);
  for (const float outside : {1.5f, 40.0f}) EXPECT_GT(clearance_at(mesh, {outside, 0, 0}), 0);
  // Within the grid, too.
  EXPECT_GT(clearance_at(build_mesh(shapes::torus(1, 0.1, 24)), {0, 0, 0}), 0.4f);
}

TEST(ClearanceGrid, IsOnlyThereIfAskedFor) {
  const Mesh without = build_mesh(shapes::cube(), {.grids = false});
  EXPECT_EQ(without.grid.cells[0], 0u);
  EXPECT_TRUE(without.clearance.steps.empty());
  EXPECT_TRUE(without.slabs.bits.empty());
  EXPECT_EQ(clearance_at(without, {9, 9, 9}), 0);
}

}  // namespace
}  // namespace ode_ext
