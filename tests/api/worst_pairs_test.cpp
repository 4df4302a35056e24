// SPDX-License-Identifier: BSD-3-Clause
// One pair, however it is made, is answered soon. Deadlines are hang guards: each of these took
// minutes, and takes less than a second, once everything about a pair was looked for among all that
// it has.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

constexpr double kDeadline = 30;  // [s]

// `mesh`, turned and moved in its own frame.
TestMesh placed(TestMesh mesh, const TestPose& pose) {
  for (std::size_t i = 0; i < mesh.vertices.size() / 3; ++i) {
    const Point v = to_world(pose, mesh.vertex(i));
    for (std::size_t k = 0; k < 3; ++k) mesh.vertices[3 * i + k] = static_cast<float>(v[k]);
  }
  return mesh;
}

// A ball of which no two triangles face quite the same way as their neighbours.
TestMesh rough_ball() {
  TestMesh mesh = make_icosphere(1, 5);
  Random random(7);
  for (std::size_t i = 0; i < mesh.vertices.size() / 3; ++i) {
    const double scale = random.uniform(0.98, 1.02);
    for (std::size_t k = 0; k < 3; ++k)
      mesh.vertices[3 * i + k] = static_cast<float>(scale * mesh.vertices[3 * i + k]);
  }
  return mesh;
}

TestMesh sticks(int count, std::uint64_t seed) {
  TestMesh mesh;
  Random random(seed);
  for (int i = 0; i < count; ++i) mesh = merged(mesh, placed(make_rod(1, 0.02), random.pose(0.3)));
  return mesh;
}

TestMesh rough_sheet(int n) {
  TestMesh mesh = make_sheet(1, n);
  Random random(3);
  for (std::size_t i = 2; i < mesh.vertices.size(); i += 3)
    mesh.vertices[i] = static_cast<float>(random.uniform(-0.02, 0.02));
  return mesh;
}

class ApiWorstPairs : public ::testing::Test {
 protected:
  // Collides two meshes, `b` placed by a pose. Checks that contacts came in time, once the meshes
  // were known, and are sound.
  void answer(const OdeMesh& a, const OdeMesh& b, const TestPose& pose) {
    const dGeomID g1 = world.geom(a, {}), g2 = world.geom(b, at(100, 0, 0));
    const BatchCollider collider;
    EXPECT_TRUE(answer_of(collider, g1, g2).empty());
    set_pose(g2, pose);
    const std::clock_t start = std::clock();
    const Contacts contacts = answer_of(collider, g1, g2);
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, kDeadline);
    EXPECT_FALSE(contacts.empty());
    for (const dContactGeom& c : contacts) {
      EXPECT_NEAR(length(normal(c)), 1, 1e-6);
      EXPECT_GE(c.depth, 0);
    }
  }

  OdeWorld world;
};

TEST_F(ApiWorstPairs, RoughBallsInOnePlaceAreAnsweredSoon) {
  const OdeMesh& ball = world.mesh(rough_ball());
  answer(ball, ball, turned({1, 2, 0.5}, 0.023));
}

TEST_F(ApiWorstPairs, SoupsOfLargeTrianglesAreAnsweredSoon) {
  answer(world.mesh(make_soup(1600, 7)), world.mesh(make_soup(1600, 8)), {});
}

TEST_F(ApiWorstPairs, BundlesOfSticksAreAnsweredSoon) {
  answer(world.mesh(sticks(240, 7)), world.mesh(sticks(240, 8)), at(0.05, 0.02, 0.03));
}

TEST_F(ApiWorstPairs, FinelyCutCubesDeepInOneAnotherAreAnsweredSoon) {
  const OdeMesh& cube = world.mesh(make_cube(1, 160));
  answer(cube, cube, turned({1, 2, 3}, 0.3, {0.02, 0.03, 0.04}));
}

TEST_F(ApiWorstPairs, AFineRoughSheetInAFlatFaceIsAnsweredSoon) {
  answer(world.mesh(rough_sheet(240)), world.mesh(make_cube(0.9)), at(0.01, 0.02, -0.45));
}

}  // namespace
}  // namespace ode_ext::test
