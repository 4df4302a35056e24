// SPDX-License-Identifier: BSD-3-Clause
// Pairs that the device has no room for, each by itself.
#include <gtest/gtest.h>

#include "collide/collider.h"
#include "opencl/error.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

using Bits = std::vector<std::vector<ContactBits>>;

// Two soups cross so often that a device of small buffers has no room for them by themselves. What
// else is in the scene is collided all the same.
TEST(GivenUpPairs, AreThoseAloneThatTheDeviceHasNoRoomFor) {
  TestScene scene = random_scene(30, 59);
  const std::size_t large = scene.pairs.size() / 2;
  TestScene all;
  for (const TestMesh& mesh : scene.meshes) all.add_mesh(mesh);
  const std::uint32_t first = all.add_mesh(make_soup(800, 7)),
                      second = all.add_mesh(make_soup(800, 8));
  for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
    if (i == large) all.add_pair(first, at(0, 0, 0), second, at(0, 0, 0));
    const auto& [a, b] = scene.pairs[i];
    all.add_pair(scene.objects[a].mesh, scene.objects[a].pose, scene.objects[b].mesh,
                 scene.objects[b].pose);
  }
  Collider whole({});
  Bits expected = bits_of(whole.collide(all.scene, nullptr));
  ASSERT_FALSE(expected[large].empty());
  EXPECT_TRUE(whole.report().given_up.empty());
  expected[large].clear();
  ColliderOptions options;
  options.whole_steps = false;  // they reserve more
  options.largest_buffer = std::uint64_t{6} << 20;
  Collider collider(options);
  PassMemory memory;
  for (int pass = 0; pass < 2; ++pass) {
    EXPECT_EQ(bits_of(collider.collide(all.scene, &memory)), expected);
    EXPECT_EQ(collider.report().given_up, std::vector<std::size_t>{large});
    EXPECT_NE(collider.report().why_given_up, "");
    EXPECT_EQ(memory.tile_pairs, 0u) << "no size of tiles helps";
  }
}

// That many in a row fail for want of memory says that the device does, whatever it calls it.
TEST(GivenUpPairs, AreFewBeforeTheDeviceIsSaidToFail) {
  TestScene scene;
  const std::uint32_t first = scene.add_mesh(make_soup(800, 7)),
                      second = scene.add_mesh(make_soup(800, 8));
  ColliderOptions options;
  options.whole_steps = false;
  options.largest_buffer = std::uint64_t{6} << 20;
  Collider collider(options);
  for (int pairs = 1; pairs <= 4; ++pairs) {
    scene.add_pair(first, at(0, 0, 0), second, at(0, 0, 0));
    if (pairs < 2) continue;
    const PairContacts& found = collider.collide(scene.scene, nullptr);
    EXPECT_EQ(found.ranges.size(), static_cast<std::size_t>(pairs));
    EXPECT_EQ(collider.report().given_up.size(), static_cast<std::size_t>(pairs));
  }
  scene.add_pair(first, at(0, 0, 0), second, at(0, 0, 0));
  EXPECT_THROW(collider.collide(scene.scene, nullptr), DeviceError);
}

}  // namespace
}  // namespace ode_ext::test
