// SPDX-License-Identifier: BSD-3-Clause
// What README.md and ode_ext.h promise of a collider of 0, of overrides, messages and descriptions.
#include <string>
#include <vector>

#include "support/batch_collider.h"
#include "support/messages.h"

namespace ode_ext::test {
namespace {

class ApiPromises : public ::testing::Test {
 protected:
  OdeWorld world;
  dSpaceID space = world.space(SpaceKind::Hash);
  Pile pile{world, space, 12, 1};
};

TEST_F(ApiPromises, AColliderOfZeroMeansPlainOde) {
  Collected stock, through;
  dSpaceCollide(space, &stock, &collect);
  ASSERT_GT(stock.total(), 0);
  EXPECT_EQ(dBatchColliderSpaceCollide(nullptr, space, &through, &collect), 1);
  EXPECT_EQ(difference_with_geoms(through, stock), "");

  const auto one = reinterpret_cast<dGeomID>(space);
  const dGeomID other = world.geom(world.mesh(make_cube(3)), {});
  Collected stock2, through2;
  dSpaceCollide2(one, other, &stock2, &collect);
  ASSERT_GT(stock2.total(), 0);
  EXPECT_EQ(dBatchColliderSpaceCollide2(nullptr, one, other, &through2, &collect), 1);
  EXPECT_EQ(difference_with_geoms(through2, stock2), "");
}

int calls_of_own_override = 0;
int own_override(dGeomID, dGeomID, int, dContactGeom*, int) {
  ++calls_of_own_override;
  return 0;
}

TEST_F(ApiPromises, AnOverrideOfTheProgramIsReplacedAndNotRestored) {
  dSetColliderOverride(dTriMeshClass, dTriMeshClass, &own_override);
  calls_of_own_override = 0;
  collide(pile.geoms[0], pile.geoms[1]);
  ASSERT_EQ(calls_of_own_override, 1);
  {
    const BatchCollider collider;
    EXPECT_FALSE(collide(pile.geoms[0], pile.geoms[1]).empty());
  }
  EXPECT_FALSE(collide(pile.geoms[0], pile.geoms[1]).empty());
  EXPECT_EQ(calls_of_own_override, 1);
}

// A mesh that is refused is a warning.
TEST_F(ApiPromises, TheLogLevelSaysWhatIsSaid) {
  TestMesh broken = make_cube(1);
  broken.vertices[0] = NAN;
  for (const auto& [level, expected] :
       {std::pair{"off", 0u}, {"error", 0u}, {"warning", 1u}, {"info", 1u}}) {
    const Environment environment("ODE_EXT_LOG", level);
    const BatchCollider collider;
    const dGeomID bad = world.geom(world.mesh(broken), {});
    const Messages messages;
    answer_of(collider, bad, pile.geoms[0]);
    EXPECT_EQ(messages.said().size(), expected) << level;
  }
  BatchCollider();  // the level is that of the environment again
}

TEST_F(ApiPromises, DevicesAreDescribedInAsManyBytesAsThereAre) {
  const int length = dBatchColliderDescribeDevices(nullptr, nullptr, 0);
  ASSERT_GT(length, 20);
  std::string whole(static_cast<std::size_t>(length) + 1, '#');
  EXPECT_EQ(dBatchColliderDescribeDevices(nullptr, whole.data(), whole.size()), length);
  EXPECT_EQ(whole.find('\0'), static_cast<std::size_t>(length));
  EXPECT_NE(whole.find(BatchCollider().stats().device), std::string::npos) << whole;
  std::string cut(11, '#');
  EXPECT_EQ(dBatchColliderDescribeDevices(nullptr, cut.data(), 10), length);
  EXPECT_EQ(cut, whole.substr(0, 9) + '\0' + '#');
}

}  // namespace
}  // namespace ode_ext::test
