// SPDX-License-Identifier: BSD-3-Clause
// Each check is shown the failure that it is there for, and a world without one.
#include "judging/checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "simulation/contact_list.h"
#include "simulation/speeds.h"

namespace falling_objects {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kHz = 60;

class DemoChecks : public testing::Test {
 protected:
  static void SetUpTestSuite() { dInitODE2(0); }
  static void TearDownTestSuite() { dCloseODE(); }
  static SimulationSettings four_objects() {
    SimulationSettings options;
    options.objects = 4;
    return options;
  }
  dBodyID body(std::size_t i) const { return scene_.objects()[i].body; }

  std::vector<std::string> warnings_;
  Scene scene_{make_shapes(), four_objects(), warnings_};
  Checks checks_{scene_, kHz};
};

TEST_F(DemoChecks, PassesAWorldInWhichNothingIsWrong) {
  EXPECT_TRUE(checks_.after_step({}, {}));
  EXPECT_THAT(checks_.failures(), IsEmpty());
  EXPECT_THAT(warnings_, IsEmpty());
}

TEST_F(DemoChecks, StopsAtAStateThatIsNotFinite) {
  dBodySetLinearVel(body(2), std::numeric_limits<double>::quiet_NaN(), 0, 0);
  EXPECT_FALSE(checks_.after_step({}, {}));
  EXPECT_THAT(checks_.failures(), ElementsAre(HasSubstr("object 2")));
}

TEST_F(DemoChecks, CountsAnObjectBelowTheGroundOnce) {
  const double z = scene_.ground().height(0, 0);
  dBodySetPosition(body(1), 0, 0, z - 0.99 * kShapeRadius);
  checks_.after_step({}, {});
  EXPECT_THAT(checks_.failures(), IsEmpty());
  dBodySetPosition(body(1), 0, 0, z - 1.01 * kShapeRadius);
  checks_.after_step({}, {});
  checks_.after_step({}, {});
  EXPECT_EQ(checks_.lost_objects(), 1u);
  EXPECT_THAT(checks_.failures(), ElementsAre(HasSubstr("bowl: 1; first: at 0.02 s object 1")));
}

TEST_F(DemoChecks, FindsAnObjectOutsideTheBowl) {
  dBodySetPosition(body(3), scene_.ground().half_size() + 0.01, 0, 50);
  checks_.after_step({}, {});
  EXPECT_EQ(checks_.lost_objects(), 1u);
}

TEST_F(DemoChecks, FindsAContactDeeperThanAnObjectIsLarge) {
  dContactGeom contact{};
  contact.g1 = scene_.objects()[0].geom;
  contact.g2 = scene_.objects()[1].geom;
  contact.depth = 2 * std::min(scene_.shape_of(0).radius, scene_.shape_of(1).radius);
  checks_.after_step({}, {&contact, 1});
  EXPECT_THAT(checks_.failures(), IsEmpty());
  contact.depth = std::nextafter(contact.depth, 2);
  checks_.after_step({}, {&contact, 1});
  EXPECT_THAT(checks_.failures(), ElementsAre(HasSubstr("object 0")));
}

TEST_F(DemoChecks, AllowsAPairToBeTooDeepForHalfASecondButNoLonger) {
  const std::vector<Penetration> deep{{0, 4, 0.2, 0.1}};
  for (int step = 5; step <= 35; step += 6) checks_.after_measurement(step, deep);
  EXPECT_THAT(checks_.failures(), IsEmpty());
  checks_.after_measurement(41, deep);
  EXPECT_THAT(checks_.failures(), ElementsAre(HasSubstr("the ground")));
}

TEST_F(DemoChecks, StartsAnewForAPairThatWasApartInBetween) {
  const std::vector<Penetration> deep{{0, 1, 0.2, 0.1}};
  for (int step = 5; step <= 35; step += 6) checks_.after_measurement(step, deep);
  checks_.after_measurement(41, {});
  for (int step = 47; step <= 77; step += 6) checks_.after_measurement(step, deep);
  EXPECT_THAT(checks_.failures(), IsEmpty());
}

TEST_F(DemoChecks, ReportsAPassInWhichTheDeviceFailed) {
  StepRecord record;
  record.status = dBatchStatusDeviceFailed;
  checks_.after_step(record, {});
  EXPECT_THAT(checks_.failures(), ElementsAre(HasSubstr("device failed")));
}

TEST_F(DemoChecks, TakesWhatIsSlowerThanAHalfStepOfFreeFallForAtRest) {
  const double half_step = kGravity / kHz / 2;
  for (std::size_t i = 0; i < 4; ++i) dBodySetLinearVel(body(i), 0, 0, -0.99 * half_step);
  checks_.collect_speeds({});
  checks_.judge_rest();
  EXPECT_THAT(checks_.failures(), IsEmpty());
  Checks others(scene_, kHz);
  for (std::size_t i = 0; i < 4; ++i) dBodySetLinearVel(body(i), 0, 0, -1.01 * half_step);
  others.collect_speeds({});
  others.judge_rest();
  EXPECT_THAT(others.failures(), ElementsAre(HasSubstr("not at rest")));
}

TEST_F(DemoChecks, SeesAllObjectsAtRestButOneThatFalls) {
  dBodySetLinearVel(body(0), 0, 0, -1.01 * kGravity / kHz);  // the mean is a quarter of it
  checks_.collect_speeds({});
  checks_.judge_rest();
  EXPECT_THAT(checks_.failures(), ElementsAre(HasSubstr("95th percentile")));
}

TEST_F(DemoChecks, SeeASheetThatIsInAnObjectOrCrossesOne) {
  Draping draping;
  draping.triangles = 8192;
  draping.crossing = 8;  // 0.098 %
  draping.deepest = kVertexMayBeInside;
  checks_.after_draping(draping);
  EXPECT_THAT(checks_.failures(), IsEmpty());
  draping.crossing = 9;
  checks_.after_draping(draping);
  EXPECT_THAT(checks_.failures(), ElementsAre(HasSubstr("9 of 8192")));
  Checks others(scene_, kHz);
  draping.crossing = 0;
  draping.inside = 1;
  others.after_draping(draping);
  EXPECT_THAT(others.failures(), ElementsAre(HasSubstr("inside an object")));
}

TEST_F(DemoChecks, SeeTheOneVertexOfASheetThatMoves) {
  StepRecord record;
  record.fastest_vertex = kVertexMayMove;
  checks_.collect_speeds(record);
  checks_.judge_rest();
  EXPECT_THAT(checks_.failures(), IsEmpty());
  record.fastest_vertex = 1.01 * kVertexMayMove;
  checks_.collect_speeds(record);
  checks_.collect_speeds({});  // slower in the last step
  checks_.judge_rest();
  EXPECT_THAT(checks_.failures(), ElementsAre(HasSubstr("vertex of a sheet")));
}

TEST_F(DemoChecks, MeasuresObjectsInEachOtherAndInTheGround) {
  const PenetrationMeter meter(scene_);
  EXPECT_EQ(meter.measure().deepest, 0);
  EXPECT_TRUE(meter.all_depths().empty());
  const dReal* p = dBodyGetPosition(body(0));
  dBodySetPosition(body(1), p[0], p[1], p[2]);
  const PenetrationMeter::Result both = meter.measure();
  ASSERT_EQ(both.too_deep.size(), 1u);
  EXPECT_EQ(both.too_deep[0].object, 0u);
  EXPECT_EQ(both.too_deep[0].other, 1u);
  EXPECT_EQ(both.deepest, both.too_deep[0].depth);
  EXPECT_EQ(meter.all_depths(), std::vector<double>{both.deepest});
  dBodySetPosition(body(1), 0, 0, scene_.ground().height(0, 0));
  ASSERT_EQ(meter.measure().too_deep.size(), 1u);
  EXPECT_EQ(meter.measure().too_deep[0].other, 4u);  // the ground
}

TEST_F(DemoChecks, HashesEveryBitOfAContact) {
  dContactGeom contact{};
  contact.g1 = scene_.objects()[0].geom;
  contact.g2 = scene_.objects()[1].geom;
  const auto hash = [&] { return hash_contacts({&contact, 1}, kHashStart); };
  const std::uint64_t before = hash();
  EXPECT_EQ(hash(), before);
  for (dReal* value : {&contact.pos[2], &contact.normal[1], &contact.depth}) {
    const dReal kept = *value;
    *value = std::nextafter(kept, 1);
    EXPECT_NE(hash(), before);
    *value = kept;
  }
  contact.side2 = 1;
  EXPECT_NE(hash(), before);
  contact.side2 = 0;
  std::swap(contact.g1, contact.g2);
  EXPECT_NE(hash(), before);
}

TEST(Quantile, IsTheMedianInTheMiddleAndTheLargestAtOne) {
  EXPECT_EQ(quantile({5, 1, 3}, 0.5), 3);
  EXPECT_EQ(quantile({5, 1, 3}, 1), 5);
  EXPECT_EQ(quantile({5, 1, 3}, 0), 1);
  EXPECT_EQ(quantile({}, 0.5), 0);
}

}  // namespace
}  // namespace falling_objects
