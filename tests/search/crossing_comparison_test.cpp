// SPDX-License-Identifier: BSD-3-Clause
#include "search/crossing_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "search/inside_oracle.h"

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

// But for vertices that bound nothing, which a flood leaves out.
TEST(RigFlooded, HitsWhatRaysOfAllVerticesHit) {
  const TestScene scene = random_scene(60, 82, kSmallClosedMeshCount);
  const auto hits = [&](bool flooded, bool bounding) {
    std::map<std::pair<ox_u32, ox_u32>, std::pair<ox_u32, ox_f32>> found;
    const StepRecords records =
        Rig::shared().run_with_edges(scene.scene, Organization::kPipelined, {8, 64}, flooded);
    for (const ox_hit& h : records.hits) {
      const Mesh& source = scene.built_mesh_of(h.pair_side >> 1, h.pair_side & 1);
      const Mesh& target = scene.built_mesh_of(h.pair_side >> 1, 1 - (h.pair_side & 1));
      const std::uint32_t mesh = InsideOracles::mesh_of(scene.scene, h.pair_side);
      if (bounding &&
          !bounding_vertices(source, target)[Rig::shared().local_vertex(mesh, h.vertex)])
        continue;
      EXPECT_TRUE(found.try_emplace({h.pair_side, h.vertex}, h.triangle, h.depth).second);
    }
    return found;
  };
  const auto flooded = hits(true, false);
  EXPECT_EQ(flooded, hits(false, true));
  const std::size_t of_all = hits(false, false).size();
  EXPECT_GT(of_all, 300u);
  EXPECT_GT(of_all, flooded.size() + 10u);
  EXPECT_GT(flooded.size(), 200u);
}

}  // namespace
}  // namespace ode_ext::test
