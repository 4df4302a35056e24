// SPDX-License-Identifier: BSD-3-Clause
// The regions of overlap that the edge contacts tell apart.
#include <gtest/gtest.h>

#include <set>

#include "pipeline/rig.h"

namespace ode_ext::test {
namespace {

// Posts upright in one face, which each of them crosses at its four edges. From 17 on (65
// crossings) the crossings of that face are found by an order of their own (OX_MOST_OF_FACET).
TEST(EdgeRegions, AreAsManyAsPostsInAFaceHoweverManyTheyAre) {
  for (const int count : {2, 16, 17, 60}) {
    TestMesh posts;
    for (int i = 0; i < count; ++i)
      posts = merged(posts, moved(make_box({0.1, 0.1, 0.5}), {0.2 * i, 0, 0.2}));
    TestScene scene;
    const std::uint32_t block = scene.add_mesh(moved(make_box({40, 2, 1}), {0, 0, -0.5}));
    scene.add_pair(scene.add_mesh(posts), {}, block, {});
    const StepRecords records = Rig::shared().run_with_edges(scene.scene, Organisation::kPipelined);
    std::set<std::uint32_t> regions;
    for (const ox_pair_crossing& c : records.gathered_crossings) {
      EXPECT_LT(c.region, static_cast<std::uint32_t>(count));
      regions.insert(c.region);
    }
    EXPECT_EQ(records.gathered_crossings.size(), 4u * static_cast<unsigned>(count));
    EXPECT_EQ(regions.size(), static_cast<std::size_t>(count));
  }
}

}  // namespace
}  // namespace ode_ext::test
