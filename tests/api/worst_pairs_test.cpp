// SPDX-License-Identifier: BSD-3-Clause
// One pair, however it is made, is answered soon. Deadlines are hang guards: each of these took
// minutes, and takes less than a second, once everything about a pair was looked for among all that
// it has.
#include "support/worst_pairs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "support/batch_collider.h"

namespace ode_ext::test {
namespace {

constexpr double kDeadline = 30;  // [s]

class ApiWorstPairs : public ::testing::Test {
 protected:
  // Checks that contacts came in time, once the meshes were known, and are sound.
  void answer(const WorstPair& pair) {
    const dGeomID g1 = world.geom(world.mesh(pair.a), {});
    const dGeomID g2 = world.geom(world.mesh(pair.b), at(100, 0, 0));
    const BatchCollider collider;
    EXPECT_TRUE(answer_of(collider, g1, g2).empty());
    set_pose(g2, pair.pose);
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

TEST_F(ApiWorstPairs, RoughBallsInOnePlaceAreAnsweredSoon) { answer(rough_balls(5)); }

TEST_F(ApiWorstPairs, SoupsOfLargeTrianglesAreAnsweredSoon) { answer(soups(1600)); }

TEST_F(ApiWorstPairs, BundlesOfSticksAreAnsweredSoon) { answer(bundles_of_sticks(240)); }

TEST_F(ApiWorstPairs, FinelyCutCubesDeepInOneAnotherAreAnsweredSoon) {
  answer(finely_cut_cubes(160));
}

TEST_F(ApiWorstPairs, AFineRoughSheetInAFlatFaceIsAnsweredSoon) {
  answer(rough_sheet_in_a_face(240));
}

}  // namespace
}  // namespace ode_ext::test
