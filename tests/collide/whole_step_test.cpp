// SPDX-License-Identifier: BSD-3-Clause
// On a processor each pair is taken through all steps by one work-item; what that gives is what the
// steps launched one by one give.
#include <gtest/gtest.h>

#include <algorithm>

#include "collide/collider.h"
#include "support/moving_scene.h"

namespace ode_ext::test {
namespace {

ColliderOptions step_by_step() {
  ColliderOptions options;
  options.whole_steps = false;
  return options;
}

double milliseconds(const Collider& collider, Stage stage) {
  return collider.report().ms[static_cast<std::size_t>(stage)];
}

// Parts of so many pairs of a scene, one after the other.
std::vector<Scene> parts_of(const Scene& scene, std::size_t size) {
  std::vector<Scene> parts;
  for (std::size_t i = 0; i < scene.pairs.size(); i += size) {
    Scene& part = parts.emplace_back(scene);
    const auto first = scene.pairs.begin() + static_cast<std::ptrdiff_t>(i);
    const std::size_t count = std::min(size, scene.pairs.size() - i);
    part.pairs.assign(first, first + static_cast<std::ptrdiff_t>(count));
  }
  return parts;
}

class WholeStep : public testing::Test {
 protected:
  // Both of all parts; how many contacts there are.
  std::size_t compare(const Scene& scene, std::size_t part) {
    std::size_t contacts = 0;
    for (const Scene& few : parts_of(scene, part)) {
      const auto expected = bits_of(stepwise_.collide(few, nullptr));
      EXPECT_EQ(milliseconds(stepwise_, Stage::kWholeStep), 0);
      EXPECT_EQ(bits_of(whole_.collide(few, nullptr)), expected);
      EXPECT_EQ(milliseconds(whole_, Stage::kWholeStep) > 0, takes_whole_steps());
      EXPECT_EQ(milliseconds(whole_, Stage::kPairStep) > 0, !takes_whole_steps());
      for (const auto& pair : expected) contacts += pair.size();
    }
    return contacts;
  }

  // Others than processors are given the steps one by one.
  bool takes_whole_steps() { return (whole_.device_info().type & CL_DEVICE_TYPE_CPU) != 0; }

  Collider whole_{{}}, stepwise_{step_by_step()};
};

TEST_F(WholeStep, GivesTheBytesOfItsStepsForOnePair) {
  EXPECT_GT(compare(random_scene(120, 11).scene, 1), 300u);
}

TEST_F(WholeStep, GivesTheSameBytesWhereNoMemoryIsShared) {
  ColliderOptions options, steps = step_by_step();
  options.share_memory = steps.share_memory = false;
  Collider apart(options), apart_stepwise(steps);
  for (const Scene& few : parts_of(random_scene(120, 11).scene, 40)) {
    const auto expected = bits_of(whole_.collide(few, nullptr));
    EXPECT_EQ(bits_of(apart.collide(few, nullptr)), expected);
    EXPECT_EQ(bits_of(apart_stepwise.collide(few, nullptr)), expected);
  }
}

TEST_F(WholeStep, GivesTheBytesOfItsStepsForFourPairs) {
  EXPECT_GT(compare(random_scene(120, 12).scene, 4), 300u);
}

TEST_F(WholeStep, GivesTheSameBytesInWhateverOrderPairsAreTaken) {
  Scene scene = random_scene(120, 12).scene;
  const auto expected = bits_of(whole_.collide(scene, nullptr));
  Random random(3);
  for (int order = 0; order < 3; ++order) {
    scene.features.clear();
    for (std::size_t i = 0; i < scene.pairs.size(); ++i)
      scene.features.push_back(static_cast<std::uint32_t>(random.below(1000)));
    EXPECT_EQ(bits_of(whole_.collide(scene, nullptr)), expected);
  }
}

TEST_F(WholeStep, SaysHowManyFeaturesAPairHas) {
  const Scene scene = random_scene(120, 12).scene;
  const PairContacts found = whole_.collide(scene, nullptr);
  const PairContacts& stepwise = stepwise_.collide(scene, nullptr);
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    EXPECT_EQ(found.ranges[i].features, stepwise.ranges[i].features);
    EXPECT_GE(found.ranges[i].features, found.ranges[i].count > 0 ? 1u : 0u);
  }
  EXPECT_GT(std::count_if(found.ranges.begin(), found.ranges.end(),
                          [](const auto& range) { return range.features > 8; }),
            20);
}

TEST_F(WholeStep, GivesTheBytesOfItsStepsForSmoothMeshes) {
  MovingScene moving(smooth_meshes(), 12, 0.01, 5);
  EXPECT_GT(compare(moving.scene(), 3), 50u);
}

TEST_F(WholeStep, GivesTheBytesOfItsStepsForDeformableMeshes) {
  TestScene scene;
  const std::uint32_t cube = scene.add_mesh(make_cube(1, 4));
  scene.scene.meshes.push_back(std::make_shared<const Mesh>(
      build_mesh(soup_of(make_sheet(2, 12)), {.open_thickness = 0.02f, .deformable = true})));
  const auto sheet = static_cast<std::uint32_t>(scene.scene.meshes.size() - 1);
  scene.add_pair(cube, turned({1, 2, 3}, 0.3, {0, 0, 0.6}), sheet, at(0, 0, 0));
  EXPECT_GT(compare(scene.scene, 1), 0u);
}

TEST_F(WholeStep, RunsAgainWhereAListWasTooShort) {
  ColliderOptions tight;
  tight.initial_capacity = 4;
  Collider collider(tight);
  const TestScene scene = random_scene(4, 13);
  const auto expected = bits_of(stepwise_.collide(scene.scene, nullptr));
  EXPECT_EQ(bits_of(collider.collide(scene.scene, nullptr)), expected);
  EXPECT_GT(collider.report().redone, 0);
}

TEST_F(WholeStep, GivesTheBytesOfItsStepsForManyPairs) {
  EXPECT_GT(compare(random_scene(600, 14).scene, 200), 1000u);
}

// Two soups, with more crossings than a share has room for.
TestScene scene_with_a_pair_that_does_not_fit() {
  TestScene scene = random_scene(20, 15);
  scene.add_pair(scene.add_mesh(make_soup(700, 1)), {}, scene.add_mesh(make_soup(700, 2)), {});
  return scene;
}

TEST_F(WholeStep, LeavesAPairThatDoesNotFitToTheSteps) {
  const TestScene scene = scene_with_a_pair_that_does_not_fit();
  const auto expected = bits_of(stepwise_.collide(scene.scene, nullptr));
  EXPECT_EQ(bits_of(whole_.collide(scene.scene, nullptr)), expected);
  EXPECT_EQ(whole_.report().left, takes_whole_steps() ? 1u : 0u);
  EXPECT_GT(whole_.report().appended[OX_LIST_CROSSINGS], 32768u);
  if (takes_whole_steps()) {
    EXPECT_LT(whole_.report().appended[OX_LIST_CROSSINGS],
              whole_.report().actual[OX_LIST_CROSSINGS]);
  }
  EXPECT_EQ(whole_.report().actual, stepwise_.report().actual);
  EXPECT_EQ(whole_.report().pairs_bounded, stepwise_.report().pairs_bounded);
}

TEST_F(WholeStep, WaitsOnceWhereItKnowsThatAPairDoesNotFit) {
  const TestScene scene = scene_with_a_pair_that_does_not_fit();
  PassMemory memory;
  const auto expected = bits_of(whole_.collide(scene.scene, &memory));
  if (takes_whole_steps()) {
    EXPECT_GT(whole_.report().synchronizations, 1);
  }
  EXPECT_EQ(bits_of(whole_.collide(scene.scene, &memory)), expected);
  EXPECT_EQ(whole_.report().synchronizations, 1);
  EXPECT_EQ(whole_.report().redone, 0);
}

}  // namespace
}  // namespace ode_ext::test
