// SPDX-License-Identifier: BSD-3-Clause
// Each expectation is shown a motion that it is meant for, and one that it is not.
#include "judging/expectations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "scene_file/scene_file.h"

namespace falling_objects {
namespace {

constexpr double kStepsPerSecond = 50;
constexpr double kTurn = 2 * std::numbers::pi;

class Expecting : public testing::Test {
 protected:
  static void SetUpTestSuite() { dInitODE2(0); }
  static void TearDownTestSuite() { dCloseODE(); }

  // Two bodies, hinged about opposite axes, and what is expected of them.
  void expect(const std::string& what) {
    expectations_.reset();
    scene_ = std::make_unique<Scene>(
        read_scene("[[body]]\nname = \"a\"\nmesh = \"cube\"\n"
                   "[[body]]\nname = \"b\"\nmesh = \"cube\"\nat = [5, 0, 0]\n"
                   "[[joint]]\nbody = \"b\"\naxis = [0, 0, -2]\n"
                   "[[expect]]\n" +
                       what,
                   "test.toml"),
        1, warnings_);
    expectations_ = std::make_unique<Expectations>(*scene_, kStepsPerSecond);
  }
  dBodyID body(std::size_t i) const { return scene_->objects()[i].body; }
  // Turns [turns/s] about z, and a rise [m/s] of the first, for a while [s].
  void move(double a, double b, double rise, double seconds) {
    for (int i = 0; i < std::lround(seconds * kStepsPerSecond); ++i) {
      dBodySetAngularVel(body(0), 0, 0, kTurn * a);
      dBodySetAngularVel(body(1), 0, 0, kTurn * b);
      dBodySetLinearVel(body(0), 0, 0, rise);
      const dReal* p = dBodyGetPosition(body(0));
      dBodySetPosition(body(0), p[0], p[1], p[2] + rise / kStepsPerSecond);
      expectations_->after_step();
    }
  }
  bool holds() const { return expectations_->outcomes().at(0).holds; }
  std::string words() const { return expectations_->outcomes().at(0).words; }

  std::vector<std::string> warnings_;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<Expectations> expectations_;
};

constexpr const char* kRatio =
    "kind = \"ratio\"\nbody = \"a\"\nother = \"b\"\nratio = -2\nwithin = 0.02\nafter = 1\n";

TEST_F(Expecting, ARatioHoldsFromTheSecondOnForWhichItIsExpected) {
  expect(kRatio);
  move(5, 1, 0, 1);
  move(2.02, 1, 0, 3);  // b's hinge points down
  EXPECT_TRUE(holds()) << words();
}

TEST_F(Expecting, ARatioFailsWithOneSecondThatIsOff) {
  expect(kRatio);
  move(2, 1, 0, 2);
  move(2.06, 1, 0, 1);
  move(2, 1, 0, 2);
  EXPECT_FALSE(holds());
  EXPECT_THAT(words(), testing::HasSubstr("off by at most 3.00 %"));
}

TEST_F(Expecting, ARatioFailsWhereNothingTurns) {
  expect(kRatio);
  move(0, 0, 0, 3);
  EXPECT_FALSE(holds());
}

constexpr const char* kScrew =
    "kind = \"screw\"\nbody = \"a\"\npitch = 0.1\nturns = 2\nwithin = 0.25\n";

TEST_F(Expecting, AScrewHoldsWhileItTurnsAlongItsThread) {
  expect(kScrew);
  move(-0.5, 0, -0.05, 3);
  EXPECT_FALSE(holds());  // too few turns yet
  move(-0.5, 0, -0.05, 2);
  EXPECT_TRUE(holds()) << words();
}

TEST_F(Expecting, AScrewFailsThatSlipsThrough) {
  expect(kScrew);
  move(-0.5, 0, -0.05, 5);
  move(0.1, 0, -0.3, 0.1);  // 0.4 pitches
  EXPECT_FALSE(holds());
}

TEST_F(Expecting, ALeftHandedScrewIsJudgedByItsOwnThread) {
  const char* left_handed =
      "kind = \"screw\"\nbody = \"a\"\npitch = -0.1\nturns = 2\nwithin = 0.25\n";
  expect(left_handed);
  move(0.5, 0, -0.05, 5);
  EXPECT_TRUE(holds()) << words();
  expect(left_handed);
  move(-0.5, 0, -0.05, 5);  // the other way
  EXPECT_FALSE(holds());
}

TEST_F(Expecting, AScrewFailsThatJams) {
  expect(kScrew);
  move(-1, 0, -0.1, 3);
  move(-0.01, 0, -0.001, 1);
  EXPECT_FALSE(holds());
}

TEST_F(Expecting, StillLooksAtTheLastSecondOnly) {
  expect("kind = \"still\"\nspeed = 0.1\n");
  move(0, 0, 2, 3);
  EXPECT_FALSE(holds());
  move(0, 0, 0.09, 1);
  EXPECT_TRUE(holds()) << words();
}

TEST_F(Expecting, StaysLooksAtEveryStepAfterItsTime) {
  expect("kind = \"stays\"\ndistance = 0.5\nafter = 1\n");
  move(0, 0, 3, 1);
  move(0, 0, 0.6, 0.1);
  EXPECT_TRUE(holds()) << words();
  move(0, 0, 0.6, 0.9);
  move(0, 0, -0.6, 1);  // back again
  EXPECT_FALSE(holds());
}

TEST_F(Expecting, StaysLooksAtNothingAfterItsEnd) {
  expect("kind = \"stays\"\ndistance = 0.5\nuntil = 1\n");
  move(0, 0, 0.4, 1);
  move(0, 0, 9, 1);
  EXPECT_TRUE(holds()) << words();
}

TEST_F(Expecting, MovesWantsOneThatGetsFarEnough) {
  expect("kind = \"moves\"\ndistance = 0.5\nafter = 1\n");
  move(0, 0, 3, 1);
  EXPECT_FALSE(holds());
  move(0, 0, 0.6, 1);
  move(0, 0, -0.6, 1);  // back again
  EXPECT_TRUE(holds()) << words();
  dBodySetPosition(body(1), 0, std::nan(""), 0);
  move(0, 0, 0, 0.1);
  EXPECT_FALSE(holds());
}

TEST_F(Expecting, AboveFailsWithOneThatWasLower) {
  expect("kind = \"above\"\nheight = -0.5\n");
  move(0, 0, -0.4, 1);
  EXPECT_TRUE(holds()) << words();
  dBodySetPosition(body(1), 5, 0, -0.6);
  move(0, 0, 0, 0.1);
  dBodySetPosition(body(1), 5, 0, 0);
  move(0, 0, 0, 1);
  EXPECT_FALSE(holds());
  dBodySetPosition(body(1), 5, 0, std::nan(""));
  move(0, 0, 0, 0.1);
  EXPECT_FALSE(holds());
}

TEST_F(Expecting, ApartFailsWithOneMeasurementThatIsDeeper) {
  expect("kind = \"apart\"\ndepth = 0.1\nafter = 1\n");
  move(0, 0, 0, 0.5);
  expectations_->after_measurement(0.3);
  move(0, 0, 0, 0.5);
  EXPECT_FALSE(holds()) << "nothing was measured in its time";
  expectations_->after_measurement(0.09);
  EXPECT_TRUE(holds()) << words();
  expectations_->after_measurement(0.11);
  expectations_->after_measurement(0);
  EXPECT_FALSE(holds());
}

TEST_F(Expecting, BodiesOfOneNameAreMeantTogether) {
  scene_ = std::make_unique<Scene>(
      read_scene("[[body]]\nmesh = \"cube\"\ncount = [12, 1, 1]\nspacing = [2, 1, 1]\n"
                 "[[body]]\nname = \"other\"\nmesh = \"cube\"\nat = [0, 9, 0]\n"
                 "[[expect]]\nkind = \"stays\"\nbody = \"cube\"\ndistance = 0.1\n",
                 "test.toml"),
      1, warnings_);
  expectations_ = std::make_unique<Expectations>(*scene_, kStepsPerSecond);
  expectations_->after_step();
  dBodySetPosition(body(12), 0, 0, 7);
  expectations_->after_step();
  EXPECT_TRUE(holds()) << words();
  EXPECT_THAT(words(), testing::HasSubstr("cube 1 to cube 12"));
  dBodySetPosition(body(11), 0, 0, 7);
  expectations_->after_step();
  EXPECT_FALSE(holds());
}

TEST_F(Expecting, NothingHoldsOfAWayOfWhichOneEndWasSeen) {
  expect("kind = \"stays\"\nbody = \"a\"\ndistance = 0.1\nafter = 2\n");
  move(0, 0, 1, 2);
  EXPECT_FALSE(holds());
  EXPECT_THAT(words(), testing::HasSubstr("too few steps after 2.0 s"));
  move(0, 0, 1, 0.04);
  EXPECT_TRUE(holds()) << words();
}

// What falls has hardly begun to.
TEST_F(Expecting, StillOfLessThanASecondIsNotTold) {
  expect("kind = \"still\"\nspeed = 0.1\n");
  move(0, 0, 0, 0.5);
  EXPECT_FALSE(holds());
  EXPECT_THAT(words(), testing::HasSubstr("too short to tell, 1 s are needed"));
  move(0, 0, 0, 0.5);
  EXPECT_TRUE(holds()) << words();
}

TEST_F(Expecting, StillLooksAtTheLastStepWhereASecondHasNone) {
  expect("kind = \"still\"\nspeed = 0.01\n");
  expectations_ = std::make_unique<Expectations>(*scene_, 0.5);
  dBodySetLinearVel(body(0), 1, 0, 0);
  expectations_->after_step();
  EXPECT_FALSE(holds()) << words();
}

TEST_F(Expecting, AHingeTurnsEitherOfItsBodies) {
  scene_ = std::make_unique<Scene>(
      read_scene("[[body]]\nname = \"frame\"\nmesh = \"cube\"\nmotion = \"fixed\"\n"
                 "[[body]]\nname = \"nut\"\nmesh = \"cube\"\nat = [5, 0, 0]\n"
                 "[[joint]]\nbody = \"frame\"\nother = \"nut\"\naxis = [1, 0, 0]\n"
                 "[[expect]]\nkind = \"screw\"\nbody = \"nut\"\npitch = 1\nturns = 1\n"
                 "within = 1e6\n",
                 "test.toml"),
      1, warnings_);
  expectations_ = std::make_unique<Expectations>(*scene_, kStepsPerSecond);
  for (int i = 0; i < 3 * kStepsPerSecond; ++i) {
    dBodySetAngularVel(body(1), kTurn, 0, 0);
    expectations_->after_step();
  }
  EXPECT_THAT(words(), testing::HasSubstr("nut turns by 3.00"));
}

TEST_F(Expecting, NothingHoldsOfARunThatIsTooShortToTell) {
  for (const char* what : {kRatio, "kind = \"stays\"\ndistance = 0.5\nafter = 2\n"}) {
    expect(what);
    move(2, 1, 0, 1.9);
    EXPECT_FALSE(holds());
    EXPECT_THAT(words(), testing::HasSubstr("a run of 1.9 s is too short to tell, 2 s"));
    move(2, 1, 0, 0.12);
    EXPECT_TRUE(holds()) << words();
  }
}

TEST_F(Expecting, NothingHoldsOfWhatIsNotANumber) {
  expect("kind = \"stays\"\ndistance = 0.5\n");
  dBodySetPosition(body(0), 0, std::nan(""), 0);
  move(0, 0, 0, 0.1);
  EXPECT_FALSE(holds());
}

}  // namespace
}  // namespace falling_objects
