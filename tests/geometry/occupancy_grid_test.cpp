// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/occupancy_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "shapes.h"

namespace ode_ext {
namespace {

// How often the surface goes around the point: the sum of the solid angles of its triangles (van
// Oosterom and Strackee 1983) over 4 pi.
double winding_number(const Mesh& mesh, Vec3f point) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3d a = Vec3d(mesh.vertices[t[0]]) - Vec3d(point);
    const Vec3d b = Vec3d(mesh.vertices[t[1]]) - Vec3d(point);
    const Vec3d c = Vec3d(mesh.vertices[t[2]]) - Vec3d(point);
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

bool is_inside(const Mesh& mesh, Vec3f point) {
  return std::fabs(winding_number(mesh, point)) > 0.5;
}

struct Counts {
  int inside = 0, outside = 0, rejected = 0;
};

// Random points of the box: none that is inside may be rejected.
Counts probe(const Mesh& mesh, int points) {
  std::mt19937 random(21);
  std::uniform_real_distribution<float> part(0, 1);
  Counts counts;
  for (int i = 0; i < points; ++i) {
    Vec3f point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      point[axis] = mesh.box.lo[axis] + part(random) * (mesh.box.hi[axis] - mesh.box.lo[axis]);
    }
    const bool possible = may_be_inside(mesh.grid, point);
    if (is_inside(mesh, point)) {
      ++counts.inside;
      EXPECT_TRUE(possible) << point.x << " " << point.y << " " << point.z;
    } else {
      ++counts.outside;
      counts.rejected += !possible;
    }
  }
  return counts;
}

TEST(OccupancyGrid, RejectsNoInsidePointAndMostOutsidePointsOfATorus) {
  const Counts counts = probe(build_mesh(shapes::torus(1, 0.3, 24)), 8000);
  EXPECT_GT(counts.inside, 2000);
  // Measured: 0.915. The others are in cells the surface passes through.
  EXPECT_GT(counts.rejected, 0.9 * counts.outside);
}

TEST(OccupancyGrid, RejectsNoInsidePointOfAnyClosedShape) {
  const TriangleSoup cavity =
      shapes::turned(shapes::box({0.25f, 0.25f, 0.25f}, {0.75f, 0.75f, 0.75f}));
  const TriangleSoup overlapping =
      shapes::joined(shapes::sphere(1, 8), shapes::moved(shapes::sphere(1, 8), 1, {0.5f, 0.1f, 0}));
  for (const TriangleSoup& soup :
       {shapes::tetrahedron(), shapes::joined(shapes::cube(), cavity), overlapping,
        shapes::box({0, 0, 0}, {1, 1, 1e-4f}), shapes::box({0, 0, 0}, {1e-5f, 1, 1e-4f}),
        shapes::turned(shapes::sphere(1, 6)), shapes::moved(shapes::torus(1, 0.3, 8), 1e6f, {}),
        shapes::moved(shapes::torus(1, 0.3, 8), 1e-6f, {}),
        shapes::moved(shapes::torus(1, 0.3, 8), 10, {1e6f, -1e6f, 1e5f})}) {
    const Mesh mesh = build_mesh(soup);
    ASSERT_TRUE(mesh.closed);
    ASSERT_GT(mesh.grid.cells[0], 0u);
    EXPECT_GT(probe(mesh, 1000).inside, 20);
  }
}

TEST(OccupancyGrid, KeepsEveryVertexAndEverythingNearIt) {
  for (const TriangleSoup& soup :
       {shapes::cube(), shapes::sphere(1, 12), shapes::torus(1, 0.3, 9)}) {
    const Mesh mesh = build_mesh(soup);
    for (const Vec3f& vertex : mesh.vertices) {
      EXPECT_TRUE(may_be_inside(mesh.grid, vertex));
      // By a quarter of the margin, out of the box as well.
      const Vec3f outward = vertex - centre(mesh.box);
      EXPECT_TRUE(may_be_inside(mesh.grid, vertex + 5e-6f * outward));
      EXPECT_TRUE(may_be_inside(mesh.grid, vertex - 5e-6f * outward));
    }
  }
}

TEST(OccupancyGrid, HasAMargin) {
  // A point 0.25 m, several cells, from the inner rim of a torus.
  const Mesh mesh = build_mesh(shapes::torus(1, 0.3, 12));
  const auto occupied = [&](float margin) {
    const OccupancyGrid grid =
        build_occupancy_grid(mesh.vertices, mesh.triangles, mesh.box.lo, mesh.box.hi, margin, true);
    return may_be_inside(grid, {0.45f, 0, 0});
  };
  EXPECT_FALSE(occupied(0));
  EXPECT_FALSE(occupied(0.1f));
  EXPECT_TRUE(occupied(0.26f));
}

TEST(OccupancyGrid, HasCubicCells) {
  for (const Vec3f size : {Vec3f{4, 2, 1}, Vec3f{1, 1, 1}, Vec3f{0.5f, 9, 2}}) {
    const OccupancyGrid grid = build_mesh(shapes::box({0, 0, 0}, size, 8)).grid;
    const Vec3f per_meter = grid.cells_per_meter;
    const float most = std::max({per_meter.x, per_meter.y, per_meter.z});
    const float least = std::min({per_meter.x, per_meter.y, per_meter.z});
    EXPECT_LT(most, 1.25f * least);  // whole cells: at least 5 on the shortest side here
  }
}

TEST(OccupancyGrid, HasMoreCellsForMoreTriangles) {
  const auto cells = [](const TriangleSoup& soup) {
    const OccupancyGrid grid = build_mesh(soup).grid;
    EXPECT_EQ(grid.bits.size(), (grid.cells[0] * grid.cells[1] * grid.cells[2] + 31) / 32);
    return grid.cells[0] * grid.cells[1] * grid.cells[2];
  };
  const std::uint32_t few = cells(shapes::cube()), more = cells(shapes::sphere(1, 16));
  EXPECT_GE(few, 4096u);
  EXPECT_LT(few, 2 * 4096u);
  EXPECT_GT(more, 10 * few);
}

// Each cell in the box of a triangle is looked at: of needles that lie askew, all of them.
TEST(OccupancyGrid, IsCoarserWhereTheBoxesOfTrianglesHoldMostOfIt) {
  const auto cells_of = [](float across) {
    std::vector<Vec3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 0; i < 4000; ++i) {
      const auto t = static_cast<float>(i) / 4000;
      const float x = std::fmod(37 * t, 1.0f), y = std::fmod(101 * t, 1.0f);
      vertices.insert(vertices.end(), {{x, y, t},
                                       {x + across, y + across, t + across},
                                       {x + across, y + across + 0.001f, t + across}});
      triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const OccupancyGrid grid =
        build_occupancy_grid(vertices, triangles, {0, 0, 0}, {2, 2, 2}, 0, false);
    return std::size_t{grid.cells[0]} * grid.cells[1] * grid.cells[2];
  };
  EXPECT_GT(cells_of(0.01f), 900000u);
  EXPECT_LT(cells_of(1), 50000u);
}

TEST(OccupancyGrid, TakesFarPointsAndPointsThatAreNotNumbersForOutside) {
  const Mesh mesh = build_mesh(shapes::cube());
  for (const float far : {-1.0f, 2.0f, 1e10f, -1e38f, INFINITY, -INFINITY, NAN}) {
    EXPECT_FALSE(may_be_inside(mesh.grid, {far, 0.5f, 0.5f}));
    EXPECT_FALSE(may_be_inside(mesh.grid, {0.5f, far, 0.5f}));
    EXPECT_FALSE(may_be_inside(mesh.grid, {0.5f, 0.5f, far}));
  }
}

TEST(OccupancyGrid, KnowsTheHoleOfATorusAndTheCavityOfAShell) {
  EXPECT_FALSE(may_be_inside(build_mesh(shapes::torus(1, 0.3, 24)).grid, {0, 0, 0}));
  // A cavity is enclosed: not reached from the border, so kept, which is on the safe side.
  const TriangleSoup cavity =
      shapes::turned(shapes::box({0.25f, 0.25f, 0.25f}, {0.75f, 0.75f, 0.75f}));
  EXPECT_TRUE(
      may_be_inside(build_mesh(shapes::joined(shapes::cube(), cavity)).grid, {0.5f, 0.5f, 0.5f}));
}

TEST(OccupancyGrid, TakesAFlatClosedMesh) {
  // A square of two sides, its corners pulled apart by nothing: closed, volume 0.
  const Vec3f a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0};
  const Mesh mesh = build_mesh({a, b, c, a, c, d, a, d, b, b, d, c});
  ASSERT_TRUE(mesh.closed);
  EXPECT_EQ(mesh.grid.cells[2], 1u);
  EXPECT_TRUE(may_be_inside(mesh.grid, {0.5f, 0.5f, 0}));
  EXPECT_FALSE(may_be_inside(mesh.grid, {0.5f, 0.5f, 0.1f}));
}

TEST(OccupancyGrid, CoversAFlatMeshThinnerThanTheRoundingOfItsPlane) {
  const float far = 1e9f;  // floats are 64 m apart here
  // The margin is lost in float, and with the last even in double.
  for (const float size : {1.0f, 0.1f, 1e-3f}) {
    const Vec3f a{far, 0, 0}, b{far, size, 0}, c{far, size, size}, d{far, 0, size};
    const Mesh mesh = build_mesh({a, b, c, a, c, d, a, d, b, b, d, c});
    ASSERT_TRUE(mesh.closed);
    EXPECT_LE(mesh.grid.cells[0], 512u);
    EXPECT_GE(mesh.grid.cells[1], 16u);
    for (const Vec3f& vertex : mesh.vertices) EXPECT_TRUE(may_be_inside(mesh.grid, vertex));
    EXPECT_TRUE(may_be_inside(mesh.grid, {far, 0.5f * size, 0.5f * size}));
    EXPECT_FALSE(may_be_inside(mesh.grid, {far, 2 * size, 0.5f * size}));
  }
}

TEST(OccupancyGrid, KeepsPointsThatRoundingMovesIntoTheNextCell) {
  // A thin triangle whose tip is at, or a few floats beside, the border of two cells: whichever the
  // float arithmetic puts the tip into must be kept, without any margin.
  const Vec3f lo{0.1f, 0.1f, 0.1f}, hi{1.3f, 0.102f, 0.102f};
  const OccupancyGrid empty = build_occupancy_grid({}, {}, lo, hi, 0, true);
  for (std::uint32_t k = 1; k < empty.cells[0]; k += 7) {
    float x = empty.origin.x + static_cast<float>(k) / empty.cells_per_meter.x;
    for (int step = 0; step < 6; ++step) x = std::nextafter(x, 0.0f);
    for (int step = 0; step < 12; ++step, x = std::nextafter(x, 2.0f)) {
      for (const float direction : {-0.01f, 0.01f}) {
        const Vec3f tip{x, 0.101f, 0.101f};
        const std::vector<Vec3f> vertices{tip, tip + Vec3f{direction, 1e-3f, 0},
                                          tip + Vec3f{direction, 0, 1e-3f}};
        const OccupancyGrid grid = build_occupancy_grid(vertices, {{0, 1, 2}}, lo, hi, 0, true);
        EXPECT_TRUE(may_be_inside(grid, tip)) << k << " " << step << " " << direction;
      }
    }
  }
}

TEST(OccupancyGrid, OfAnOpenMeshKnowsItsSurfaceButNoInside) {
  const OccupancyGrid open = build_mesh(shapes::sheet(3)).grid;
  EXPECT_TRUE(open.bits.empty());
  EXPECT_FALSE(open.surface.empty());
  EXPECT_TRUE(may_be_inside(open, {1e6f, 0, 0}));
}

TEST(OccupancyGrid, IsOnlyThereForMeshesOfAMeasurableSize) {
  for (const float scale : {1e-35f, 1e35f}) {
    const Mesh mesh = build_mesh(shapes::moved(shapes::cube(), scale, {}));
    EXPECT_TRUE(mesh.closed);
    EXPECT_TRUE(may_be_inside(mesh.grid, {0.5f * scale, 0.5f * scale, 0.5f * scale}));
  }
}

}  // namespace
}  // namespace ode_ext
