// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/crossing_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <tuple>

namespace ode_ext::test {
namespace {

// A square rod right through a plate, off the diagonals of its sides: eight crossings.
struct RodThroughPlate : testing::Test {
  const TestScene scene =
      one_pair(make_rod(2, 0.2), turned({0, 1, 0}, std::acos(-1.0) / 2, {0.13, 0.26, 0}),
               make_box({1, 1, 0.1}), at(0, 0, 0));
  const std::vector<ReferenceSurface> surfaces{scene.meshes.begin(), scene.meshes.end()};
  std::map<CrossingKey, FoundCrossing> found =
      found_crossings(scene, Rig::shared().run_with_edges(scene.scene, Organization::kPipelined));

  std::vector<std::string> differences() const {
    return compare_crossings(scene, surfaces, found).differences;
  }
};

TEST_F(RodThroughPlate, IsCrossedAsBruteForceSays) {
  EXPECT_EQ(found.size(), 8u);
  EXPECT_TRUE(differences().empty()) << differences().front();
}

TEST_F(RodThroughPlate, LacksWhatIsTakenAway) {
  found.erase(found.begin());
  ASSERT_EQ(differences().size(), 1u);
  EXPECT_NE(differences().front().find("lacks"), std::string::npos) << differences().front();
}

TEST_F(RodThroughPlate, HasNothingThatIsAdded) {
  CrossingKey key = found.begin()->first;
  std::get<4>(key) = (std::get<4>(key) + 5) % 12;
  ASSERT_TRUE(found.emplace(key, found.begin()->second).second);
  ASSERT_EQ(differences().size(), 1u);
  EXPECT_NE(differences().front().find("nothing is crossed"), std::string::npos);
}

TEST_F(RodThroughPlate, IsNotCrossedElsewhereOrTheOtherWay) {
  found.begin()->second.t += 1e-4;
  std::next(found.begin())->second.leaves = !std::next(found.begin())->second.leaves;
  EXPECT_EQ(differences().size(), 2u);
}

// But for vertices that bound nothing: it knows that they are inside, and does not ask for a face.
TEST(RigFlooded, HitsWhatRaysOfAllVerticesHit) {
  const TestScene scene = random_scene(60, 82, kSmallClosedMeshCount);
  const auto run = [&](bool flooded) {
    return Rig::shared().run_with_edges(scene.scene, Organization::kPipelined, {8, 64}, flooded);
  };
  std::map<std::pair<ox_u32, ox_u32>, std::pair<ox_u32, ox_f32>> by_rays;
  for (const ox_hit& h : run(false).hits) by_rays[{h.pair_side, h.vertex}] = {h.triangle, h.depth};
  EXPECT_GT(by_rays.size(), 300u);
  const StepRecords flooded = run(true);
  EXPECT_EQ(flooded.hits.size(), by_rays.size());
  std::set<std::pair<ox_u32, ox_u32>> bound_nothing;
  for (const ox_feature& f : flooded.features)
    if ((f.flags & OX_FEATURE_VERTEX) != 0 && (f.flags & OX_FEATURE_FLAT) != 0)
      bound_nothing.insert({f.pair << 1 | (f.flags & OX_FEATURE_SIDE), f.source});
  std::size_t without = 0;
  for (const ox_hit& h : flooded.hits) {
    const std::pair<ox_u32, ox_u32> vertex{h.pair_side, h.vertex};
    ASSERT_TRUE(by_rays.count(vertex) != 0);
    if (bound_nothing.count(vertex) != 0) {
      EXPECT_EQ(h.triangle, OX_NONE);
      ++without;
    } else {
      EXPECT_EQ(std::make_pair(h.triangle, h.depth), by_rays[vertex]);
    }
  }
  EXPECT_GT(without, 10u);
  EXPECT_LT(without, by_rays.size() - 100);
}

}  // namespace
}  // namespace ode_ext::test
