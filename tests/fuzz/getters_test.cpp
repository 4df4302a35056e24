// SPDX-License-Identifier: BSD-3-Clause
// That what getters promise would be missed if it were not kept.
#include "fuzz/getters.h"

#include <gtest/gtest.h>

#include <vector>

namespace ode_ext::fuzz {
namespace {

constexpr int kCrossing = dBatchOverlapCrossing, kInside = dBatchOverlapFirstInside;

using Found = std::vector<dBatchContactRegion>;

TEST(FuzzGetters, TakeRegionsInTheOrderInWhichTheyComeUp) {
  const Found found{{0, kCrossing}, {1, kInside}, {0, kCrossing}, {2, kCrossing}};
  EXPECT_EQ(misnumbered({found}), "");
  EXPECT_EQ(misnumbered({Found{}}), "");
}

TEST(FuzzGetters, FlagRegionsOutOfOrderUnlessSomeWereRefused) {
  const Found late{{1, kCrossing}}, gap{{0, kCrossing}, {2, kCrossing}};
  for (const Found& found : {late, gap}) {
    EXPECT_NE(misnumbered({found}), "");
    EXPECT_EQ(misnumbered({found, false}), "");
  }
  EXPECT_NE(misnumbered({Found{{-1, kCrossing}}, false}), "");
}

TEST(FuzzGetters, FlagARegionThatOverlapsInTwoWaysOrInNone) {
  EXPECT_NE(misnumbered({Found{{0, kCrossing}, {0, kInside}}}), "");
  EXPECT_NE(misnumbered({Found{{0, 4}}}), "");
  const Found none{{0, dBatchOverlapNone}};
  EXPECT_NE(misnumbered({none}), "");
  EXPECT_EQ(misnumbered({none, true, false}), "");
}

TEST(FuzzGetters, FlagTrianglesThatAreInNoMeshletOrInOneThatIsNotThere) {
  test::TestMesh mesh = test::make_cube(1);  // twelve triangles
  std::vector<int> meshlets(12);
  EXPECT_EQ(scattered(meshlets, 1, mesh), "");
  EXPECT_NE(scattered(meshlets, 2, mesh), "");  // one without a triangle
  EXPECT_NE(scattered(meshlets, -1, mesh), "");
  meshlets[3] = 1;
  EXPECT_NE(scattered(meshlets, 1, mesh), "");
  EXPECT_EQ(scattered(meshlets, 2, mesh), "");
  meshlets[3] = -1;
  EXPECT_NE(scattered(meshlets, 1, mesh), "");
  mesh.indices[9] = mesh.indices[10];  // which has two corners in one place
  EXPECT_EQ(scattered(meshlets, 1, mesh), "");
  meshlets[3] = 0;
  EXPECT_NE(scattered(meshlets, 1, mesh), "");
}

TEST(FuzzGetters, FlagAMeshletOfMoreThanSixteenTriangles) {
  const test::TestMesh mesh = test::make_cube(1, 2);  // 48 triangles
  std::vector<int> meshlets;
  for (int i = 0; i < 48; ++i) meshlets.push_back(i / 16);
  EXPECT_EQ(scattered(meshlets, 3, mesh), "");
  meshlets[16] = 0;
  EXPECT_NE(scattered(meshlets, 3, mesh), "");
}

}  // namespace
}  // namespace ode_ext::fuzz
