// SPDX-License-Identifier: BSD-3-Clause
// On a processor few pairs are collided by one launch; what that gives is what the steps launched
// one by one give.
#include <gtest/gtest.h>

#include "pipeline/collider.h"
#include "pipeline/moving_scene.h"

namespace ode_ext::test {
namespace {

ColliderOptions step_by_step() {
  ColliderOptions options;
  options.few_pairs = 0;
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
      const bool is_cpu = (whole_.device_info().type & CL_DEVICE_TYPE_CPU) != 0;
      EXPECT_EQ(milliseconds(whole_, Stage::kWholeStep) > 0, is_cpu);
      EXPECT_EQ(milliseconds(whole_, Stage::kPairStep) > 0, !is_cpu);
      for (const auto& pair : expected) contacts += pair.size();
    }
    return contacts;
  }

  Collider whole_{{}}, stepwise_{step_by_step()};
};

TEST_F(WholeStep, GivesTheBytesOfItsStepsForOnePair) {
  EXPECT_GT(compare(random_scene(120, 11).scene, 1), 300u);
}

TEST_F(WholeStep, GivesTheBytesOfItsStepsForFourPairs) {
  EXPECT_GT(compare(random_scene(120, 12).scene, 4), 300u);
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

TEST_F(WholeStep, IsNotForManyPairsNorForLargeMeshes) {
  whole_.collide(random_scene(5, 14).scene, nullptr);
  EXPECT_EQ(milliseconds(whole_, Stage::kWholeStep), 0);
  const TestMesh large = make_icosphere(1, 5);  // 20,480 triangles
  whole_.collide(one_pair(large, at(0, 0, 0), large, at(1.9, 0, 0)).scene, nullptr);
  EXPECT_EQ(milliseconds(whole_, Stage::kWholeStep), 0);
}

}  // namespace
}  // namespace ode_ext::test
