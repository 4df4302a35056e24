// SPDX-License-Identifier: BSD-3-Clause
// No ray escapes from a closed mesh, not even through an edge or a corner of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/rig.h"

namespace ode_ext::test {
namespace {

// How many of the vertices of a (all inside b) have no hit on b.
std::size_t escaped(const TestScene& scene) {
  const StepRecords records = Rig::shared().run(scene.scene);
  std::set<ox_u32> hit;
  for (const ox_hit& h : records.hits)
    if ((h.pair_side & 1) == 0) hit.insert(h.vertex);
  return scene.built_mesh_of(0, 0).vertices.size() - hit.size();
}

// The middle of the source is that of the target, in frames that make the rays' coordinates exact,
// almost exact, and anything.
std::vector<TestPose> frames() {
  Random random(31);
  std::vector<TestPose> frames{at(0, 0, 0), at(0.5, -0.25, 1024), at(1e6, -1e6, 1e6),
                               turned({0, 0, 1}, 1.5707963267948966)};
  for (int i = 0; i < 12; ++i) frames.push_back(random.pose(10));
  return frames;
}

// Axis-parallel rays from the faces meet the grid's corners, those from edges run in a plane of
// symmetry into edges, and those from corners into corners.
TEST(Watertight, KeepsRaysThroughTheCornersAndEdgesOfACube) {
  for (const int n : {1, 2, 4, 8, 16}) {
    for (const TestPose& frame : frames()) {
      EXPECT_EQ(escaped(one_pair(make_cube(0.5, 4), frame, make_cube(1, n), frame)), 0u) << n;
      // Shifted by an eighth of a cell: through edges, but not corners.
      const TestPose shifted = composed(frame, at(0.125 / n, 0, 0));
      EXPECT_EQ(escaped(one_pair(make_cube(0.5, 4), shifted, make_cube(1, n), frame)), 0u) << n;
    }
  }
}

// Rays through the centre meet the corner opposite to the one they come from.
TEST(Watertight, KeepsRaysThroughTheCornersOfASphere) {
  for (int subdivisions = 0; subdivisions < 4; ++subdivisions) {
    const TestMesh inner = make_icosphere(0.5, subdivisions);
    for (const TestPose& frame : frames()) {
      for (int finer = subdivisions; finer < 4; ++finer)
        EXPECT_EQ(escaped(one_pair(inner, frame, make_icosphere(1, finer), frame)), 0u);
    }
  }
}

// A torus of squares: rays from a smaller one in the same tube hit its rings of edges.
TEST(Watertight, KeepsRaysThroughTheEdgesOfATorus) {
  for (const TestPose& frame : frames()) {
    EXPECT_EQ(escaped(one_pair(make_torus(1, 0.2, 24, 8), frame, make_torus(1, 0.4, 24, 8), frame)),
              0u);
    EXPECT_EQ(
        escaped(one_pair(make_torus(1, 0.2, 24, 8), frame, make_torus(1, 0.4, 48, 16), frame)), 0u);
  }
}

TEST(Watertight, KeepsRaysInLongThinTriangles) {
  for (const TestPose& frame : frames()) {
    EXPECT_EQ(escaped(one_pair(make_box({90, 0.05, 0.05}, 64, 2, 2), frame,
                               make_box({100, 0.1, 0.1}, 3, 1, 1), frame)),
              0u);
    EXPECT_EQ(
        escaped(one_pair(make_cube(0.04, 4), frame, make_box({100, 0.1, 0.1}, 1, 64, 64), frame)),
        0u);
  }
}

// 100,000 rays in all directions from anywhere inside.
TEST(Watertight, KeepsAHundredThousandRaysInAMeshOfSmallTriangles) {
  const TestMesh source = make_icosphere(0.3, 4);
  const TestMesh targets[] = {jittered(make_icosphere(1, 4), 0.01, 1), make_cube(1.6, 12)};
  Random random(32);
  std::size_t rays = 0;
  for (int i = 0; i < 40; ++i) {
    const TestPose target = random.pose(0.2);
    const TestPose inside = composed(target, random.pose(0.25));
    const TestScene scene = one_pair(source, inside, targets[i % 2], target);
    rays += scene.built_mesh_of(0, 0).vertices.size();
    EXPECT_EQ(escaped(scene), 0u);
  }
  EXPECT_GT(rays, 100000u);
}

}  // namespace
}  // namespace ode_ext::test
