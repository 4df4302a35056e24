// SPDX-License-Identifier: BSD-3-Clause
// Hits and crossings come in whatever order the device finds them; the contacts do not tell.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <vector>

#include "support/rig.h"
#include "support/test_scene.h"

namespace ode_ext::test {
namespace {

// All but the number of the region, which is the order's.
using Words = std::array<ox_u32, offsetof(ox_contact, region) / sizeof(ox_u32)>;

std::vector<std::vector<Words>> contacts_of(const StepRecords& records) {
  std::vector<std::vector<Words>> contacts;
  for (const ox_range& range : records.ranges) {
    contacts.emplace_back();
    for (ox_u32 i = 0; i < range.count; ++i)
      std::memcpy(&contacts.back().emplace_back(), &records.contacts.at(range.first + i),
                  sizeof(Words));
  }
  return contacts;
}

// Faces on faces, edges on edges and corners on corners: points of several regions and edges in one
// place, as deep as one another.
TestScene aligned_scene(int pairs) {
  TestScene scene;
  const std::array meshes{scene.add_mesh(make_cube(1, 1)),
                          scene.add_mesh(make_cube(1, 4)),
                          scene.add_mesh(make_l(1)),
                          scene.add_mesh(make_comb(4, 1, 1, 0.5)),
                          scene.add_mesh(make_torus(0.5, 0.25, 8, 8)),
                          scene.add_mesh(make_tetrahedron(1))};
  Random random(91);
  for (int i = 0; i < pairs; ++i) {
    const auto multiple = [&](double size) { return size * std::floor(random.uniform(-4, 5)); };
    const Point axis{double(i % 3 == 0), double(i % 3 == 1), double(i % 3 == 2)};
    scene.add_pair(meshes[i % 6], at(3.0 * i, 0, 0), meshes[(i / 6) % 6],
                   turned(axis, multiple(std::numbers::pi / 4),
                          {3.0 * i + multiple(0.125), multiple(0.125), multiple(0.125)}));
  }
  return scene;
}

void expect_the_same_for_every_launch(const TestScene& scene) {
  const auto contacts = [&](Launch launch) {
    return contacts_of(
        Rig::shared().run_with_edges(scene.scene, Organization::kPipelined, launch, true));
  };
  const auto expected = contacts({1, 64});
  std::size_t colliding = 0;
  for (const auto& of_pair : expected) colliding += of_pair.empty() ? 0 : 1;
  EXPECT_GT(2 * colliding, scene.pairs.size());
  for (const std::size_t groups : {2, 3, 8, 50}) {
    const auto found = contacts({groups, 64});
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_EQ(found[i], expected[i]) << "pair " << i << ", groups " << groups;
  }
}

TEST(AppendOrder, ChangesNoByteOfTheContactsOfWhatIsAligned) {
  expect_the_same_for_every_launch(aligned_scene(2000));
}

}  // namespace
}  // namespace ode_ext::test
