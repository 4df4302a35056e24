// SPDX-License-Identifier: BSD-3-Clause
// Iterative rays give the bytes of full ones, whatever was computed before; the paper's do not, and
// say what they dropped.
#include <gtest/gtest.h>

#include "collide/collider.h"
#include "support/moving_scene.h"

namespace ode_ext::test {
namespace {

using Bits = std::vector<std::vector<ContactBits>>;

ColliderOptions with_rays(Rays rays) {
  ColliderOptions options;
  options.rays = rays;
  options.count_work = rays == Rays::kFull;  // all of them list vertices by their own rays
  return options;
}

std::uint64_t iterative(const BatchReport& report) {
  return report.actual[static_cast<std::size_t>(List::kRaysIterative)];
}
std::uint64_t bvh(const BatchReport& report) {
  return report.actual[static_cast<std::size_t>(List::kRays)];
}

class IterativePasses : public testing::Test {
 protected:
  // Collides the scene both ways and compares.
  void pass(const Scene& scene, PassMemory& passes) {
    const Bits expected = bits_of(full.collide(scene, nullptr));
    ASSERT_EQ(bits_of(iterative_rays.collide(scene, &passes)), expected);
    cast_iteratively += iterative(iterative_rays.report());
    cast_in_full += bvh(iterative_rays.report());
    // What a walk finds is never believed.
    EXPECT_EQ(iterative_rays.report().unproven, iterative(iterative_rays.report()));
  }

  Collider full{with_rays(Rays::kFull)};
  Collider iterative_rays{with_rays(Rays::kIterative)};
  PassMemory memory;
  std::uint64_t cast_iteratively = 0, cast_in_full = 0;
};

TEST_F(IterativePasses, GiveTheBytesOfFullRaysOnSmoothMeshes) {
  MovingScene moving(smooth_meshes(), 40, 0.002, 1);
  for (int i = 0; i < 30; ++i, moving.advance()) pass(moving.scene(), memory);
  // Else nothing was shown.
  EXPECT_GT(cast_iteratively, 30000u);
}

TEST_F(IterativePasses, GiveTheBytesOfFullRaysOnMeshesOfAllKinds) {
  MovingScene moving(small_closed_meshes(), 200, 0.005, 2);
  for (int i = 0; i < 30; ++i, moving.advance()) pass(moving.scene(), memory);
  EXPECT_GT(cast_iteratively, 500u);
}

TEST_F(IterativePasses, GiveTheBytesOfFullRaysAfterLargeDisplacements) {
  for (const double size : {0.01, 0.03, 0.1, 0.3}) {
    MovingScene moving(smooth_meshes(), 20, size, 3);
    PassMemory passes;
    for (int i = 0; i < 8; ++i, moving.advance()) pass(moving.scene(), passes);
  }
}

TEST_F(IterativePasses, FindTemporalDataOfEveryVertexOfAPairThatRests) {
  MovingScene moving(smooth_meshes(), 40, 0, 4);
  pass(moving.scene(), memory);
  EXPECT_EQ(iterative(iterative_rays.report()), 0u);
  const std::uint64_t before = cast_in_full;
  pass(moving.scene(), memory);
  // What met nothing near has nothing to start from.
  EXPECT_GT(iterative(iterative_rays.report()), before / 2);
}

TEST_F(IterativePasses, ArePairsThatComeAndGo) {
  MovingScene moving(smooth_meshes(), 60, 0.002, 5);
  Random random(5);
  const auto all = moving.scene().pairs;
  for (int i = 0; i < 40; ++i, moving.advance()) {
    moving.scene().pairs.clear();
    for (const auto& pair : all)
      if (random.below(4) != 0) moving.scene().pairs.push_back(pair);
    pass(moving.scene(), memory);
  }
  EXPECT_GT(cast_iteratively, 500u);
}

TEST_F(IterativePasses, DoNotMindInWhichOrderAPairIsGiven) {
  MovingScene moving(smooth_meshes(), 40, 0.002, 6);
  Random random(6);
  for (int i = 0; i < 20; ++i, moving.advance()) {
    for (auto& pair : moving.scene().pairs)
      if (random.below(2) == 0) std::swap(pair[0], pair[1]);
    pass(moving.scene(), memory);
  }
  EXPECT_GT(cast_iteratively, 5000u);
}

TEST_F(IterativePasses, StartAnewWhereAMeshIsReplaced) {
  MovingScene moving(smooth_meshes(), 40, 0.002, 7);
  const std::vector<std::shared_ptr<const Mesh>> meshes = moving.scene().meshes;
  for (std::size_t i = 0; i < 20; ++i, moving.advance()) {
    // The same object has another mesh, of fewer triangles or more, from one pass to the next.
    for (std::size_t k = 0; k < 3; ++k) moving.scene().meshes[k] = meshes[(k + i / 3) % 3];
    pass(moving.scene(), memory);
  }
  EXPECT_GT(cast_iteratively, 500u);
}

TEST_F(IterativePasses, KeepSpacesApart) {
  MovingScene first(smooth_meshes(), 20, 0.002, 8), second(small_closed_meshes(), 20, 0.004, 9);
  PassMemory other;
  for (int i = 0; i < 20; ++i, first.advance(), second.advance()) {
    pass(first.scene(), memory);
    pass(second.scene(), other);
    pass(second.scene(), other);
  }
  EXPECT_GT(cast_iteratively, 5000u);
}

TEST_F(IterativePasses, SurviveListsThatAreTooSmall) {
  ColliderOptions tight = with_rays(Rays::kIterative);
  tight.initial_capacity = 1;
  tight.confidence = 0.5;
  Collider collider(tight);
  MovingScene moving(smooth_meshes(), 20, 0.002, 10);
  for (int i = 0; i < 6; ++i, moving.advance()) {
    const Bits expected = bits_of(full.collide(moving.scene(), nullptr));
    ASSERT_EQ(bits_of(collider.collide(moving.scene(), &memory)), expected);
  }
  EXPECT_GT(iterative(collider.report()), 0u);
}

TEST_F(IterativePasses, HandOnWhatTheyCannotWalkTo) {
  ColliderOptions options = with_rays(Rays::kIterative);
  options.walk_limit = 0;
  options.displacement_limit = 100;
  Collider collider(options);
  MovingScene moving(smooth_meshes(), 20, 0.05, 11);
  std::uint64_t handed_on = 0;
  for (int i = 0; i < 6; ++i, moving.advance()) {
    const Bits expected = bits_of(full.collide(moving.scene(), nullptr));
    ASSERT_EQ(bits_of(collider.collide(moving.scene(), &memory)), expected);
    handed_on += collider.report().unproven;
  }
  EXPECT_GT(handed_on, 100u);
}

TEST_F(IterativePasses, AreNotUsedOutsideOfPasses) {
  MovingScene moving(smooth_meshes(), 10, 0, 12);
  for (int i = 0; i < 3; ++i) iterative_rays.collide(moving.scene(), nullptr);
  EXPECT_EQ(iterative(iterative_rays.report()), 0u);
  EXPECT_EQ(iterative_rays.report().temporal_pairs, 0u);
}

TEST_F(IterativePasses, ForgetWhatNobodyCollidesAnyMore) {
  MovingScene moving(smooth_meshes(), 30, 0, 13);
  pass(moving.scene(), memory);
  EXPECT_EQ(iterative_rays.report().temporal_pairs, 30u);
  moving.scene().pairs.resize(5);
  for (int i = 0; i < 10; ++i) pass(moving.scene(), memory);
  EXPECT_EQ(iterative_rays.report().temporal_pairs, 5u);
}

TEST(IterativePaper, DropsVerticesWithoutTemporalDataAndCountsThem) {
  Collider full(with_rays(Rays::kFull)), paper(with_rays(Rays::kIterativePaper));
  MovingScene moving(smooth_meshes(), 40, 0.003, 14);
  PassMemory memory;
  std::size_t found = 0, expected = 0;
  std::uint64_t dropped = 0;
  for (int i = 0; i < 20; ++i, moving.advance()) {
    expected += full.collide(moving.scene(), nullptr).contacts.size();
    found += paper.collide(moving.scene(), &memory).contacts.size();
    dropped += paper.report().dropped;
  }
  EXPECT_GT(dropped, 0u);
  EXPECT_GT(found, expected / 2);
}

TEST(IterativePaper, CastsInFullAgainOnceThePairHasMovedFar) {
  Collider paper(with_rays(Rays::kIterativePaper));
  MovingScene moving(smooth_meshes(), 1, 0.01, 15);
  PassMemory memory;
  int in_full = 0;
  for (int i = 0; i < 60; ++i, moving.advance()) {
    paper.collide(moving.scene(), &memory);
    if (paper.report().actual[static_cast<std::size_t>(List::kChunks)] > 0) ++in_full;
  }
  EXPECT_GT(in_full, 1);
  EXPECT_LT(in_full, 30);
}

}  // namespace
}  // namespace ode_ext::test
