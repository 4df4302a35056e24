// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/surface_slabs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "shapes.h"

namespace ode_ext {
namespace {

// Gentle hills over the floor of a closed slab: its triangles are much larger than its cells.
TriangleSoup hills() {
  TriangleSoup soup = shapes::box({-4, -4, -1}, {4, 4, 0}, 12);
  for (Vec3f& p : soup)
    if (p.z == 0) p.z = 0.2f * std::sin(p.x) * std::cos(p.y);
  return soup;
}

std::vector<TriangleSoup> soups() {
  const TriangleSoup cavity =
      shapes::turned(shapes::box({0.25f, 0.25f, 0.25f}, {0.75f, 0.75f, 0.75f}));
  return {hills(),
          shapes::sphere(1, 24),
          shapes::torus(1, 0.3, 16),
          shapes::turned(shapes::sphere(1, 12)),
          shapes::joined(shapes::cube(), cavity),
          shapes::box({0, 0, 0}, {4, 4, 0.1f}, 6),
          shapes::sheet(6),
          shapes::moved(shapes::torus(1, 0.3, 12), 1, {1e3f, -1e3f, 0})};
}

Vec3d cell_of(const Mesh& mesh) {
  const Vec3f per_meter = mesh.grid.cells_per_meter;
  return {1 / double{per_meter.x}, 1 / double{per_meter.y}, 1 / double{per_meter.z}};
}

using Visit = std::function<void(Vec3d centre, const SurfaceSlab&)>;

void for_each_slab(const Mesh& mesh, const Visit& visit) {
  const Vec3d cell = cell_of(mesh);
  std::array<std::size_t, 3> at{};
  std::size_t block = 0;
  for (at[2] = 0; at[2] < mesh.clearance.blocks[2]; ++at[2])
    for (at[1] = 0; at[1] < mesh.clearance.blocks[1]; ++at[1])
      for (at[0] = 0; at[0] < mesh.clearance.blocks[0]; ++at[0], ++block) {
        Vec3d centre(mesh.grid.origin);
        for (std::size_t k = 0; k < 3; ++k)
          centre[k] += (static_cast<double>(at[k]) + 0.5) * kBlockCells * cell[k];
        if (const SurfaceSlab* slab = find_slab(mesh.slabs, block)) visit(centre, *slab);
      }
}

// Whether a point is within reach of the block around a centre.
bool is_near(const Mesh& mesh, Vec3d centre, Vec3d point) {
  const Vec3d cell = cell_of(mesh);
  for (std::size_t k = 0; k < 3; ++k)
    if (std::fabs(point[k] - centre[k]) > 0.5 * kBlockCells * cell[k] + double{mesh.slabs.reach})
      return false;
  return true;
}

// The generalized winding number (van Oosterom and Strackee 1983): how often the mesh surrounds it.
double winding(const Mesh& mesh, Vec3d point) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3d a = Vec3d(mesh.vertices[t[0]]) - point, b = Vec3d(mesh.vertices[t[1]]) - point,
                c = Vec3d(mesh.vertices[t[2]]) - point;
    sum +=
        std::atan2(dot(a, cross(b, c)), length(a) * length(b) * length(c) + dot(a, b) * length(c) +
                                            dot(b, c) * length(a) + dot(c, a) * length(b));
  }
  return sum / (2 * std::numbers::pi);
}

TEST(SurfaceSlabs, HoldTheSurfaceAsFarAsTheyReach) {
  std::mt19937 random(61);
  std::uniform_real_distribution<double> part(0, 1);
  for (const TriangleSoup& soup : soups()) {
    const Mesh mesh = build_mesh(soup);
    std::vector<Vec3d> surface;
    for (int i = 0; i < 20000; ++i) {
      const Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
      const double u = part(random), v = part(random) * (1 - u);
      const Vec3d a(mesh.vertices[t[0]]), b(mesh.vertices[t[1]]), c(mesh.vertices[t[2]]);
      surface.push_back(i % 8 == 0 ? a : a + u * (b - a) + v * (c - a));
    }
    std::sort(surface.begin(), surface.end(), [](Vec3d a, Vec3d b) { return a.x < b.x; });
    std::size_t held = 0;
    for_each_slab(mesh, [&](Vec3d centre, const SurfaceSlab& slab) {
      const double reach = double{mesh.slabs.reach} + kBlockCells * cell_of(mesh).x;
      auto at = std::lower_bound(surface.begin(), surface.end(), centre.x - reach,
                                 [](Vec3d p, double x) { return p.x < x; });
      for (; at != surface.end() && at->x < centre.x + reach; ++at) {
        if (!is_near(mesh, centre, *at)) continue;
        ++held;
        const double height = dot(Vec3d(slab.normal), *at - centre);
        ASSERT_GE(height, double{slab.lo});
        ASSERT_LE(height, double{slab.hi});
      }
    });
    EXPECT_GT(held, 1000u);
  }
}

TEST(SurfaceSlabs, HaveNothingInsideAboveWhereTheySaySo) {
  std::mt19937 random(62);
  std::uniform_real_distribution<double> sign(-1, 1);
  for (const TriangleSoup& soup : soups()) {
    const Mesh mesh = build_mesh(soup);
    int above = 0;
    for_each_slab(mesh, [&](Vec3d centre, const SurfaceSlab& slab) {
      EXPECT_TRUE(mesh.closed || slab.outside == 0);
      if (slab.outside == 0 || above > 3000) return;
      Vec3d point = centre;
      for (std::size_t k = 0; k < 3; ++k)
        point[k] +=
            sign(random) * (0.5 * kBlockCells * cell_of(mesh)[k] + double{mesh.slabs.reach});
      if (dot(Vec3d(slab.normal), point - centre) <= double{slab.hi}) return;
      ++above;
      EXPECT_LT(std::fabs(winding(mesh, point)), 0.5);
    });
    EXPECT_TRUE(!mesh.closed || above > 50) << above;
  }
}

TEST(SurfaceSlabs, AreThinOnAFloorOfLargeTriangles) {
  const Mesh mesh = build_mesh(hills());
  std::vector<double> thickness;
  std::size_t outside = 0;
  for_each_slab(mesh, [&](Vec3d centre, const SurfaceSlab& slab) {
    if (centre.z < -0.4 || std::fabs(centre.x) > 3.5 || std::fabs(centre.y) > 3.5) return;
    thickness.push_back(double{slab.hi} - double{slab.lo});
    outside += slab.outside;
  });
  ASSERT_GT(thickness.size(), 300u);
  EXPECT_GT(outside, thickness.size() / 2);
  std::nth_element(thickness.begin(), thickness.begin() + 150, thickness.end());
  // A block and its reach are 4 cells across, the hills bend by 0.2 m per square metre at most.
  const double across = 4 * cell_of(mesh).x;
  EXPECT_LT(thickness[150], 0.2 * across * across + 0.2 * across);
}

TEST(SurfaceSlabs, AreNotFoundWhereThereAreNone) {
  EXPECT_EQ(find_slab(SurfaceSlabs{}, 0), nullptr);
  const Mesh mesh = build_mesh(shapes::sphere(1, 24));
  std::size_t found = 0;
  for (std::size_t block = 0; block < mesh.clearance.steps.size(); ++block)
    found += find_slab(mesh.slabs, block) != nullptr;
  EXPECT_EQ(found, mesh.slabs.slabs.size());
  EXPECT_LT(found, mesh.clearance.steps.size() / 2);
}

}  // namespace
}  // namespace ode_ext
