// SPDX-License-Identifier: BSD-3-Clause
// Which places pairs get for their temporal data; what is made of them is in iterative_test.cpp.
#include "paper/temporal_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/moving_scene.h"

namespace ode_ext::test {
namespace {

class Places : public testing::Test {
 protected:
  // A scene of `objects`, all of one mesh, of which each neighbours in the list are a pair.
  void fill(std::size_t objects) {
    scene_.meshes = {fine_};
    for (std::size_t i = 0; i < objects; ++i) {
      scene_.objects.push_back({{}, 0, i + 1});
      if (i > 0)
        scene_.pairs.push_back({static_cast<std::uint32_t>(i - 1), static_cast<std::uint32_t>(i)});
    }
  }

  static std::shared_ptr<const Mesh> mesh(const TestMesh& made) {
    return std::make_shared<const Mesh>(build_mesh(soup_of(made)));
  }

  std::vector<ox_link> pass() {
    cache_.begin(scene_);
    std::vector<ox_link> links(scene_.pairs.size());
    cache_.links().read(links.data(), links.size() * sizeof(ox_link));
    device_.finish();
    return links;
  }

  // The entries of the directory that are taken by more than one chunk, or are not there.
  std::size_t taken_twice(const std::vector<ox_link>& links) const {
    std::vector<int> owners(cache_.entries(), 0);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      for (std::size_t side = 0; side < 2; ++side) {
        const Mesh& mesh = *scene_.meshes[scene_.objects[scene_.pairs[i][side]].mesh];
        for (std::size_t k = 0; k < mesh.topology->chunks.size(); ++k) {
          const std::size_t entry = links[i].directory[side] + k;
          if (entry >= owners.size() || owners[entry]++ != 0) ++wrong;
        }
      }
    }
    return wrong;
  }

  Device device_{""};
  TemporalCache cache_{device_};
  const std::shared_ptr<const Mesh> fine_ = mesh(make_icosphere(1, 3));
  Scene scene_;
};

TEST_F(Places, OfAMeshThatIsEditedInEveryStepAreTakenAgain) {
  fill(20);
  pass();
  const std::size_t entries = cache_.entries();
  for (int i = 0; i < 50; ++i) {
    const auto rebuilt = std::make_shared<Mesh>(*fine_);
    rebuilt->topology = std::make_shared<const MeshTopology>(*fine_->topology);
    scene_.meshes[0] = rebuilt;
    pass();
  }
  EXPECT_EQ(cache_.entries(), entries);
}

TEST_F(Places, OfAMeshThatGrowsAndShrinksAreTakenAgain) {
  fill(10);
  for (int i = 0; i < 60; ++i) {
    // 32 to 992 vertices, 2 to 62 chunks.
    scene_.meshes[0] = mesh(make_torus(1, 0.3, 8 + 4 * (i % 30), 4 + i % 30 / 7));
    pass();
  }
  // Places are rounded up to powers of two, and all the smaller ones together are one more.
  const std::size_t largest = 128;
  EXPECT_LE(cache_.entries(), 2 * largest * scene_.pairs.size());
}

TEST_F(Places, OfPairsThatNobodyCollidesAnyMoreAreTakenAgain) {
  fill(20);
  pass();
  const std::size_t entries = cache_.entries();
  for (int i = 0; i < 100; ++i) {
    // Others, of the same meshes, now and then.
    if (i % 20 == 0)
      for (Scene::Object& object : scene_.objects) object.identity += scene_.objects.size();
    pass();
  }
  // The pairs that went are kept for a few passes beside those that came.
  EXPECT_LE(cache_.entries(), 2 * entries);
}

TEST_F(Places, AreNeverThoseOfTwoPairs) {
  Random random(1);
  const std::shared_ptr<const Mesh> meshes[] = {mesh(make_cube(1, 2)), mesh(make_icosphere(1, 2)),
                                                fine_};
  fill(30);
  scene_.meshes.assign(scene_.objects.size(), fine_);
  for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) scene_.objects[i].mesh = i;
  const auto all = scene_.pairs;
  for (int i = 0; i < 60; ++i) {
    for (auto& mesh : scene_.meshes)
      if (random.below(4) == 0) mesh = meshes[random.below(3)];
    scene_.pairs.clear();
    for (const auto& pair : all)
      if (random.below(8) != 0) scene_.pairs.push_back(pair);
    const std::vector<ox_link> links = pass();
    ASSERT_EQ(taken_twice(links), 0u) << i;
    ASSERT_TRUE(std::none_of(links.begin(), links.end(),
                             [](const ox_link& link) { return link.pose == OX_NONE; }));
  }
}

TEST_F(Places, AreNotReadByANewOwnerInItsFirstPass) {
  fill(10);
  pass();
  for (const ox_link& link : pass()) EXPECT_EQ(link.known, 1u);
  const auto rebuilt = std::make_shared<Mesh>(*fine_);
  rebuilt->topology = std::make_shared<const MeshTopology>(*fine_->topology);
  scene_.meshes[0] = rebuilt;
  for (const ox_link& link : pass()) EXPECT_EQ(link.known, 0u);
  for (const ox_link& link : pass()) EXPECT_EQ(link.known, 1u);
}

}  // namespace
}  // namespace ode_ext::test
